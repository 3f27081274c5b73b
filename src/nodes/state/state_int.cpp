// state_int: whole numbers of the point that is shaded.
#include "scene/describe.h"
#include "scene/shade_services.h"

namespace lightsieve {
namespace {

enum class Variable : std::int32_t {
    X,
    Y,
    Si,
    Transparency,
    Rt,
    Bounces,
    BouncesDiffuse,
    BouncesSpecular,
    BouncesReflect,
    BouncesTransmit,
    BouncesVolume,
    Fi,
    InstId,
    Nlights,
    Id
};
std::vector<std::string> variables() {
    return {"x",
            "y",
            "si",
            "transp_index",
            "Rt",
            "bounces",
            "bounces_diffuse",
            "bounces_specular",
            "bounces_reflect",
            "bounces_transmit",
            "bounces_volume",
            "fi",
            "inst_id",
            "nlights",
            "id"};
}

struct StateInt {
    Variable variable = Variable::X;

    static NodeType describe() {
        Describe<StateInt> d("state_int", NodeKind::Shader, "A whole number of the shaded point.");
        d.param(
             "variable", &StateInt::variable,
             "x, y: the pixel; si: the sample; Rt: the ray's type as a visibility bit; bounces "
             "and those of one kind; fi: the face; nlights: lights of the scene; id, inst_id: of "
             "the shape.")
            .names(variables());
        d.reads_ray_type();
        return d.done();
    }
    [[nodiscard]] std::int32_t eval(const ShadePoint& at) const;
};

std::int32_t StateInt::eval(const ShadePoint& at) const {
    static const RayState none;
    const RayState& ray = at.ray != nullptr ? *at.ray : none;
    switch (variable) {
        case Variable::X: return ray.x;
        case Variable::Y: return ray.y;
        case Variable::Si: return static_cast<std::int32_t>(ray.sample);
        case Variable::Transparency: return ray.transparent;
        case Variable::Rt: return ray_bit(at.ray_type);
        case Variable::Bounces: return ray.bounces;
        case Variable::BouncesDiffuse: return ray.diffuse;
        case Variable::BouncesSpecular: return ray.specular + ray.transmission;
        case Variable::BouncesReflect: return ray.specular;
        case Variable::BouncesTransmit: return ray.transmission;
        case Variable::BouncesVolume: return ray.volume;
        case Variable::Fi: return static_cast<std::int32_t>(at.face);
        case Variable::Nlights: return at.services != nullptr ? at.services->n_lights() : 0;
        case Variable::InstId:
        case Variable::Id: return static_cast<std::int32_t>(at.shape_id);
    }
    return 0;
}

}  // namespace

NodeType node_state_int() { return StateInt::describe(); }

}  // namespace lightsieve
