// state_vector: points and directions of the point that is shaded.
#include "scene/describe.h"
#include "scene/shade_services.h"

namespace lightsieve {
namespace {

enum class Variable : std::int32_t {
    Ro,
    Rd,
    Po,
    P,
    DPdx,
    DPdy,
    N,
    Nf,
    Ng,
    Ngf,
    Ns,
    DPdu,
    DPdv,
    DDdx,
    DDdy,
    DNdx,
    DNdy
};

struct StateVector {
    Variable variable = Variable::Ro;

    static NodeType describe();
    [[nodiscard]] Vec3f eval(const ShadePoint& at) const;
};

NodeType StateVector::describe() {
    Describe<StateVector> d("state_vector", NodeKind::Shader,
                            "A point or direction of the shaded point, world space.");
    d.param(
         "variable", &StateVector::variable,
         "Ro, Rd: the ray's origin and direction; P: the point, Po: in object space; N, Ns: the "
         "shading normal, Ng: the geometric one, Nf, Ngf: toward the viewer; dPdu, dPdv; dPdx, "
         "dPdy: the ray's footprint.")
        .names({"Ro", "Rd", "Po", "P", "dPdx", "dPdy", "N", "Nf", "Ng", "Ngf", "Ns", "dPdu",
                "dPdv", "dDdx", "dDdy", "dNdx", "dNdy"});
    return d.done();
}

Vec3f StateVector::eval(const ShadePoint& at) const {
    const Vec3f outward = at.entering ? at.geometric_normal : -at.geometric_normal;
    switch (variable) {
        case Variable::Ro: return at.position + at.wo * at.ray_length;
        case Variable::Rd: return at.direction;
        case Variable::Po:
            return at.services != nullptr ? at.services->object_from_world(at).point(at.position)
                                          : at.position;
        case Variable::P: return at.position;
        case Variable::DPdx: return Frame::from_z(outward).x * at.width;
        case Variable::DPdy: return Frame::from_z(outward).y * at.width;
        case Variable::N:
        case Variable::Ns: return at.entering ? at.normal : -at.normal;
        case Variable::Nf: return at.normal;
        case Variable::Ng: return at.geometric_normal;
        case Variable::Ngf: return outward;
        case Variable::DPdu: return at.dp_du;
        case Variable::DPdv: return at.dp_dv;
        // Directions and normals do not change along a footprint that is taken for flat.
        case Variable::DDdx:
        case Variable::DDdy:
        case Variable::DNdx:
        case Variable::DNdy: break;
    }
    return {};
}

}  // namespace

NodeType node_state_vector() { return StateVector::describe(); }

}  // namespace lightsieve
