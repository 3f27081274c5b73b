// imager_color_correct: saturation, contrast, gamma, gain and offset, of all tones and of dark, middle and bright ones.
//
// Arnold's manual names the parameters and not the formulas. Those here are what compositing tools do with parameters of
// these names (contrast turns about 0.18, in that order), and what counts as dark and bright fades between the usual
// luminances: shadows from 0 to 0.09, highlights from 0.5 to 1.
#include <algorithm>
#include <cmath>

#include "core/color.h"
#include "nodes/imager/imager_common.h"

namespace lightsieve {
namespace {

constexpr float kPivot = 0.18F, kShadowsEnd = 0.09F, kHighlightsBegin = 0.5F, kHighlightsFull = 1;

/// The five knobs of a range of tones.
struct Tones {
    float saturation = 1, contrast = 1, gamma = 1;
    Color gain{1, 1, 1}, offset;

    [[nodiscard]] Color operator()(Color c) const {
        const float grey = luminance(c);
        for (int i = 0; i < 3; ++i) {
            float v = grey + (c[i] - grey) * saturation;
            // Powers of what is below black say nothing: it keeps its value.
            if (v > 0 && contrast != 1) v = kPivot * std::pow(v / kPivot, contrast);
            if (v > 0 && gamma != 1) v = std::pow(v, 1 / gamma);
            v = v * gain[i] + offset[i];
            if (std::isfinite(v)) c[i] = v;
        }
        return c;
    }
};

/// Smooth from 0 at `low` to 1 at `high`.
float fade(float v, float low, float high) {
    const float t = std::clamp((v - low) / (high - low), 0.0F, 1.0F);
    return t * t * (3 - 2 * t);
}

struct Change {
    Tones main, shadows, midtones, highlights;

    [[nodiscard]] Color operator()(Color c) const {
        const Color all = main(c);
        const float y = luminance(all);
        const float dark = 1 - fade(y, 0, kShadowsEnd),
                    bright = fade(y, kHighlightsBegin, kHighlightsFull);
        Color out = all;
        out += (shadows(all) - all) * dark;
        out += (midtones(all) - all) * (1 - dark - bright);
        out += (highlights(all) - all) * bright;
        return out;
    }
};

struct ImagerColorCorrect : ImagerCommon {
    Tones main, shadows, midtones, highlights;

    static NodeType describe();
    [[nodiscard]] std::unique_ptr<Imager> make_imager(NodeContext& context) const {
        return make_imager_of(*this, context, Change{main, shadows, midtones, highlights});
    }
};

void describe_tones(Describe<ImagerColorCorrect>& d, Tones ImagerColorCorrect::* tones,
                    const std::string& prefix, const std::string& of) {
    const auto knob = [tones](auto member) {
        return [tones, member](ImagerColorCorrect& n) -> auto& { return (n.*tones).*member; };
    };
    d.part(prefix + "_saturation", knob(&Tones::saturation),
           "How colourful" + of + " are; 0: grey.")
        .hard_range(0, 100);
    d.part(prefix + "_contrast", knob(&Tones::contrast), "Contrast of" + of + ", about 0.18.")
        .hard_range(0, 100);
    d.part(prefix + "_gamma", knob(&Tones::gamma), "The 1/gamma-th power of" + of + '.')
        .hard_range(0.01F, 100);
    d.part(prefix + "_gain", knob(&Tones::gain), "Factor on" + of + '.');
    d.part(prefix + "_offset", knob(&Tones::offset), "Added to" + of + '.');
}

NodeType ImagerColorCorrect::describe() {
    Describe<ImagerColorCorrect> d(
        "imager_color_correct", NodeKind::Imager,
        "Corrects the colours of the written picture: of all of it, then by brightness.");
    describe_imager_common(d);
    describe_tones(d, &ImagerColorCorrect::main, "main", " all tones");
    describe_tones(d, &ImagerColorCorrect::shadows, "shadows", " dark tones");
    describe_tones(d, &ImagerColorCorrect::midtones, "midtones", " middle tones");
    describe_tones(d, &ImagerColorCorrect::highlights, "highlights", " bright tones");
    return d.done();
}

}  // namespace

NodeType node_imager_color_correct() { return ImagerColorCorrect::describe(); }

}  // namespace lightsieve
