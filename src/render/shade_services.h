// Answers what shaders ask about a hit: user data, uv sets, placement, probes.
//
// One object a scene; what it is asked about is in the ShadePoint (`shape` is the SceneObject). Instances show the user
// data of what they place, where they have none of their own.
#pragma once

#include <map>
#include <vector>

#include "render/scene.h"
#include "scene/graph.h"
#include "scene/shade_services.h"

namespace lightsieve {

class SceneServices final : public ShadeServices {
  public:
    explicit SceneServices(const Scene& scene) : scene_(scene) {}
    /// Gathers what look-ups on a shape need; called once for every shape node before rendering.
    void prepare(const NodeInstance& shape);

    [[nodiscard]] bool user_value(const ShadePoint& at, Name name,
                                  ShaderValue& out) const override;
    [[nodiscard]] bool user_text(const ShadePoint& at, Name name, Name& out) const override;
    [[nodiscard]] bool uv_set(const ShadePoint& at, Name name, UvPoint& out) const override;
    [[nodiscard]] Mat4f world_from_object(const ShadePoint& at) const override;
    [[nodiscard]] Mat4f object_from_world(const ShadePoint& at) const override;
    [[nodiscard]] bool triangle(const ShadePoint& at, Triangle& out) const override;
    [[nodiscard]] Name shape_name(const ShadePoint& at) const override;
    [[nodiscard]] Name material_name(const ShadePoint& at) const override;
    [[nodiscard]] std::vector<Name> user_values(const ShadePoint& at, Name name) const override;
    [[nodiscard]] bool trace(const ShadePoint& at, const Probe& probe,
                             ProbeHit& hit) const override;
    [[nodiscard]] std::int32_t n_lights() const override;

  private:
    struct Spot;
    struct Found;
    [[nodiscard]] Found find(const ShadePoint& at, Name name) const;
    [[nodiscard]] bool spot_of(const ShadePoint& at, const Found& found, Spot& out) const;

    const Scene& scene_;
    /// First value of each curve in varying user data, of curves nodes that have such data.
    std::map<const NodeInstance*, std::vector<std::uint32_t>> curve_starts_;
};

}  // namespace lightsieve
