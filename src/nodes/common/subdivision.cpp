#include "nodes/common/subdivision.h"

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <cmath>
#include <utility>

namespace lightsieve {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// A vector as OpenSubdiv blends it.
template <class T>
struct Blended {
    T value{};
    void Clear(void* = nullptr) { value = {}; }
    void AddWithWeight(const Blended& other, float weight) {
        value = value + other.value * weight;
    }
};

Sdc::Options::FVarLinearInterpolation uv_rule(UvSmoothing smoothing) {
    switch (smoothing) {
        case UvSmoothing::PinCorners: return Sdc::Options::FVAR_LINEAR_CORNERS_ONLY;
        case UvSmoothing::PinBorders: return Sdc::Options::FVAR_LINEAR_BOUNDARIES;
        case UvSmoothing::Linear: return Sdc::Options::FVAR_LINEAR_ALL;
        case UvSmoothing::Smooth: break;
    }
    return Sdc::Options::FVAR_LINEAR_NONE;
}

std::unique_ptr<Far::TopologyRefiner> make_refiner(const SubdivisionCage& cage) {
    std::vector<int> n_corners;
    for (std::size_t i = 0; i + 1 < cage.first_corner.size(); ++i)
        n_corners.push_back(static_cast<int>(cage.first_corner[i + 1] - cage.first_corner[i]));
    const std::vector<int> vertex(cage.vertex.begin(), cage.vertex.end()),
        uv(cage.uv.begin(), cage.uv.end());
    std::vector<int> creases, corners;
    std::vector<float> crease_sharpness, corner_sharpness;
    for (const SubdivisionCage::Crease& c : cage.creases) {
        if (c.first == c.second) {
            corners.push_back(static_cast<int>(c.first));
            corner_sharpness.push_back(c.sharpness);
            continue;
        }
        creases.insert(creases.end(), {static_cast<int>(c.first), static_cast<int>(c.second)});
        crease_sharpness.push_back(c.sharpness);
    }

    Far::TopologyDescriptor topology;
    topology.numVertices = static_cast<int>(cage.n_vertices);
    topology.numFaces = static_cast<int>(n_corners.size());
    topology.numVertsPerFace = n_corners.data();
    topology.vertIndicesPerFace = vertex.data();
    topology.numCreases = static_cast<int>(crease_sharpness.size());
    topology.creaseVertexIndexPairs = creases.data();
    topology.creaseWeights = crease_sharpness.data();
    topology.numCorners = static_cast<int>(corners.size());
    topology.cornerVertexIndices = corners.data();
    topology.cornerWeights = corner_sharpness.data();
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = static_cast<int>(cage.n_uvs);
    channel.valueIndices = uv.data();
    if (!cage.uv.empty()) {
        topology.numFVarChannels = 1;
        topology.fvarChannels = &channel;
    }
    // What is wrong with creases is reported by who calls; what is refused gives no refiner.
    Far::SetErrorCallback([](Far::ErrorType, const char*) {});
    Far::SetWarningCallback([](const char*) {});
    Sdc::Options options;
    // Borders stay in place; corners of open meshes become round, as other corners do.
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    options.SetFVarLinearInterpolation(uv_rule(cage.uv_smoothing));
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(
        topology,
        Factory::Options(cage.linear ? Sdc::SCHEME_BILINEAR : Sdc::SCHEME_CATMARK, options)));
}

/// Follows the quads of each level to where they lie in the faces of the first.
std::shared_ptr<const MeshOrigin> find_origin(const Far::TopologyRefiner& refiner,
                                              const SubdivisionCage& cage) {
    auto out = std::make_shared<MeshOrigin>();
    out->first_corner = cage.first_corner;
    out->corner = cage.corner;
    out->vertex = cage.vertex;
    out->size_in_quads = std::ldexp(1.0F, -cage.levels);
    out->size_in_others = std::ldexp(1.0F, 1 - cage.levels);
    const auto n_faces = static_cast<std::uint32_t>(refiner.GetLevel(0).GetNumFaces());
    out->face.resize(n_faces);
    for (std::uint32_t i = 0; i < n_faces; ++i)
        out->face[i] = i;
    out->quarter.assign(n_faces, 0);
    out->place.assign(n_faces, {});
    const auto is_quad = [&](std::uint32_t face) {
        return cage.first_corner[face + 1] - cage.first_corner[face] == 4;
    };
    constexpr std::array<Vec2f, 4> kToward{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (int level = 0; level < cage.levels; ++level) {
        const Far::TopologyLevel& coarse = refiner.GetLevel(level);
        const auto n = static_cast<std::size_t>(refiner.GetLevel(level + 1).GetNumFaces());
        std::vector<std::uint32_t> face(n), quarter(n);
        std::vector<Vec2f> place(n);
        for (int parent = 0; parent < coarse.GetNumFaces(); ++parent) {
            const auto p = static_cast<std::size_t>(parent);
            const bool quad = is_quad(out->face[p]);
            const Far::ConstIndexArray children = coarse.GetFaceChildFaces(parent);
            for (int i = 0; i < children.size(); ++i) {
                const auto child = static_cast<std::size_t>(children[i]);
                face[child] = out->face[p];
                quarter[child] = out->quarter[p];
                if (level == 0 && !quad) {
                    quarter[child] = static_cast<std::uint32_t>(i);
                    continue;
                }
                const float size = std::ldexp(1.0F, -(quad ? level + 1 : level));
                place[child] = out->place[p] + kToward[static_cast<std::size_t>(i)] * size;
            }
        }
        out->face = std::move(face);
        out->quarter = std::move(quarter);
        out->place = std::move(place);
    }
    return out;
}

template <class T>
std::vector<Blended<T>> blended(std::span<const T> values) {
    std::vector<Blended<T>> out;
    out.reserve(values.size());
    for (const T& v : values)
        out.push_back({v});
    return out;
}

template <class T>
std::vector<T> plain(const std::vector<Blended<T>>& values) {
    std::vector<T> out;
    out.reserve(values.size());
    for (const Blended<T>& v : values)
        out.push_back(v.value);
    return out;
}

std::vector<std::uint32_t> corners_of(const Far::TopologyLevel& level, bool uv) {
    std::vector<std::uint32_t> out;
    out.reserve(static_cast<std::size_t>(level.GetNumFaces()) * 4);
    for (int i = 0; i < level.GetNumFaces(); ++i) {
        const Far::ConstIndexArray face =
            uv ? level.GetFaceFVarValues(i, 0) : level.GetFaceVertices(i);
        for (int k = 0; k < face.size(); ++k)
            out.push_back(static_cast<std::uint32_t>(face[k]));
    }
    return out;
}

}  // namespace

double n_refined_quads(std::span<const std::uint32_t> first_corner, int levels) {
    // The first level makes as many quads of a face as it has corners, each further one four of each.
    const double n_corners = first_corner.empty() ? 0 : first_corner.back();
    return n_corners * std::pow(4.0, levels - 1);
}

struct Subdivision::Refined {
    std::unique_ptr<Far::TopologyRefiner> refiner;
    [[nodiscard]] const Far::TopologyLevel& last() const {
        return refiner->GetLevel(refiner->GetMaxLevel());
    }
};

Subdivision::Subdivision(const SubdivisionCage& cage) : refined_(std::make_unique<Refined>()) {
    refined_->refiner = make_refiner(cage);
    if (!refined_->refiner) return;
    Far::TopologyRefiner::UniformOptions options(cage.levels);
    options.fullTopologyInLastLevel = true;  // limits ask for what surrounds a vertex
    refined_->refiner->RefineUniform(options);
    origin_ = find_origin(*refined_->refiner, cage);
}

Subdivision::~Subdivision() = default;

bool Subdivision::valid() const { return refined_->refiner != nullptr; }

std::vector<Vec3f> Subdivision::positions(std::span<const Vec3f> cage,
                                          std::vector<Vec3f>* normals) const {
    const Far::PrimvarRefiner refine(*refined_->refiner);
    std::vector<Blended<Vec3f>> values = blended(cage);
    for (int level = 1; level <= refined_->refiner->GetMaxLevel(); ++level) {
        std::vector<Blended<Vec3f>> next(
            static_cast<std::size_t>(refined_->refiner->GetLevel(level).GetNumVertices()));
        refine.Interpolate(level, values, next);
        values = std::move(next);
    }
    std::vector<Blended<Vec3f>> limit(values.size());
    if (normals == nullptr) {
        refine.Limit(values, limit);
        return plain(limit);
    }
    std::vector<Blended<Vec3f>> du(values.size()), dv(values.size());
    refine.Limit(values, limit, du, dv);
    normals->resize(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        (*normals)[i] = normalize(cross(du[i].value, dv[i].value), {});
    return plain(limit);
}

std::vector<Vec2f> Subdivision::uvs(std::span<const Vec2f> cage) const {
    const Far::PrimvarRefiner refine(*refined_->refiner);
    std::vector<Blended<Vec2f>> values = blended(cage);
    for (int level = 1; level <= refined_->refiner->GetMaxLevel(); ++level) {
        std::vector<Blended<Vec2f>> next(
            static_cast<std::size_t>(refined_->refiner->GetLevel(level).GetNumFVarValues(0)));
        refine.InterpolateFaceVarying(level, values, next);
        values = std::move(next);
    }
    std::vector<Blended<Vec2f>> limit(values.size());
    refine.LimitFaceVarying(values, limit);
    return plain(limit);
}

std::vector<std::uint32_t> Subdivision::quads() const {
    return corners_of(refined_->last(), false);
}

std::vector<std::uint32_t> Subdivision::uv_quads() const {
    return corners_of(refined_->last(), true);
}

}  // namespace lightsieve
