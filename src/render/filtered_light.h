// A light with filters (scene/light_filter.h) in front of it.
//
// Everything but the colour that arrives is the light's own, so whatever samples or meets lights needs to know nothing of
// filters, and both strategies of multiple importance sampling see the same light.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "scene/light.h"
#include "scene/light_filter.h"

namespace lightsieve {

class FilteredLight final : public Light {
  public:
    FilteredLight(std::unique_ptr<Light> light, std::vector<std::unique_ptr<LightFilter>> filters)
        : light_(std::move(light)), filters_(std::move(filters)) {}

    [[nodiscard]] LightSample sample(Vec3f from, Vec2f u) const override {
        return sample_facing(from, {}, u);
    }
    [[nodiscard]] LightSample sample_facing(Vec3f from, Vec3f normal, Vec2f u) const override {
        LightSample s = light_->sample_facing(from, normal, u);
        if (s.pdf > 0) s.radiance = filtered(s.radiance, from, s.wi, s.distance);
        return s;
    }
    [[nodiscard]] LightEval hit(Vec3f from, const LightHit& at) const override {
        LightEval eval = light_->hit(from, at);
        const Vec3f toward = at.position - from;
        eval.radiance = filtered(eval.radiance, from, normalize(toward), length(toward));
        return eval;
    }
    [[nodiscard]] LightEval escape(Vec3f from, Vec3f direction) const override {
        return escape_facing(from, {}, direction);
    }
    [[nodiscard]] LightEval escape_facing(Vec3f from, Vec3f normal,
                                          Vec3f direction) const override {
        LightEval eval = light_->escape_facing(from, normal, direction);
        eval.radiance = filtered(eval.radiance, from, direction, kInfinity);
        return eval;
    }
    [[nodiscard]] LightEval seen(Vec3f from, Vec3f direction) const override {
        LightEval eval = light_->seen(from, direction);
        eval.radiance = filtered(eval.radiance, from, direction, kInfinity);
        return eval;
    }
    void set_portals(std::span<const Light* const> portals) override {
        light_->set_portals(portals);
    }
    [[nodiscard]] const ShapeGeometry* geometry() const override { return light_->geometry(); }
    [[nodiscard]] bool infinite() const override { return light_->infinite(); }
    [[nodiscard]] bool is_skydome() const override { return light_->is_skydome(); }
    [[nodiscard]] LightBounds bounds() const override { return light_->bounds(); }
    [[nodiscard]] float irradiance() const override { return light_->irradiance(); }

  private:
    [[nodiscard]] Color filtered(Color radiance, Vec3f to, Vec3f wi, float distance) const {
        if (is_black(radiance)) return radiance;
        const Vec3f from = to + wi * (distance < kInfinity ? distance : 1);
        for (const auto& filter : filters_)
            radiance = filter->filtered(radiance, from, to, distance);
        return radiance;
    }

    std::unique_ptr<Light> light_;
    std::vector<std::unique_ptr<LightFilter>> filters_;
};

}  // namespace lightsieve
