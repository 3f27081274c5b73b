// light_decay: a light's reach, beyond or below which it fades out.
#include <cmath>

#include "scene/describe.h"
#include "scene/light_filter.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct LightDecay {
    bool use_near_atten = false, use_far_atten = false;
    float near_start = 0, near_end = 0, far_start = 0, far_end = 0;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<LightFilter> make_light_filter(NodeContext& context,
                                                                 const LightPlace& place) const;
};

NodeType LightDecay::describe() {
    Describe<LightDecay> d("light_decay", NodeKind::LightFilter,
                           "Fades a light out near it or far from it.");
    d.param("use_near_atten", &LightDecay::use_near_atten, "The light fades in near it.");
    d.param("near_start", &LightDecay::near_start, "No light up to this distance.")
        .unit("scene units");
    d.param("near_end", &LightDecay::near_end, "All of the light from this distance on.")
        .unit("scene units");
    d.param("use_far_atten", &LightDecay::use_far_atten, "The light fades out far from it.");
    d.param("far_start", &LightDecay::far_start, "All of the light up to this distance.")
        .unit("scene units");
    d.param("far_end", &LightDecay::far_end, "No light from this distance on.")
        .unit("scene units");
    return d.done();
}

/// 0 before `start`, 1 after `end`, linear between them.
float rise(float x, float start, float end) {
    if (!(end > start)) return x < start ? 0.0F : 1.0F;
    return std::clamp((x - start) / (end - start), 0.0F, 1.0F);
}

class Decay final : public LightFilter {
  public:
    explicit Decay(const LightDecay& node) : node_(node) {}
    [[nodiscard]] Color filtered(Color radiance, Vec3f, Vec3f, float distance) const override {
        float factor = 1;
        if (node_.use_near_atten) factor *= rise(distance, node_.near_start, node_.near_end);
        if (node_.use_far_atten) factor *= 1 - rise(distance, node_.far_start, node_.far_end);
        return radiance * factor;
    }

  private:
    LightDecay node_;
};

std::unique_ptr<LightFilter> LightDecay::make_light_filter(NodeContext&, const LightPlace&) const {
    return std::make_unique<Decay>(*this);
}

}  // namespace

NodeType node_light_decay() { return LightDecay::describe(); }

}  // namespace lightsieve
