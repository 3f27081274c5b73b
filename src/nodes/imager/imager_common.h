// What all imagers have: the imager before them, a switch, and the layers that they act on.
#pragma once

#include <optional>
#include <utility>

#include "core/error.h"
#include "scene/describe.h"
#include "scene/driver.h"
#include "scene/imager.h"
#include "scene/node_context.h"
#include "scene/selection.h"

namespace lightsieve {

struct ImagerCommon {
    NodeRef input;
    bool enable = true;
    Name layer_selection = "RGBA or RGBA_denoise";
};

template <class T>
void describe_imager_common(Describe<T>& d) {
    d.param("input", &ImagerCommon::input, "The imager that acts before this one.");
    d.param("enable", &ImagerCommon::enable, "Off: it changes nothing.");
    d.param("layer_selection", &ImagerCommon::layer_selection,
            "Layers that it acts on: names with * ? [abc], or r'regular expressions', joined by "
            "or, and, not, "
            "and parentheses. Empty: all colours.");
}

/// An imager whose colours come from a function.
///
/// Change: Color operator()(Color) const
template <class Change>
class ImagerOf final : public Imager {
  public:
    ImagerOf(std::optional<Selection> layers, Change change)
        : layers_(std::move(layers)), change_(std::move(change)) {}
    [[nodiscard]] bool selects(const ImageLayer& layer) const override {
        return !layers_ || layers_->matches_text(layer.name) || layers_->matches_text(layer.aov);
    }
    [[nodiscard]] Color changed(Color color) const override { return change_(color); }

  private:
    std::optional<Selection> layers_;
    Change change_;
};

/// Null if it is switched off, or its selection cannot be read, which is reported.
template <class Change>
[[nodiscard]] std::unique_ptr<Imager> make_imager_of(const ImagerCommon& common,
                                                     NodeContext& context, Change change) {
    if (!common.enable) return nullptr;
    std::optional<Selection> layers;
    if (!common.layer_selection.empty()) {
        try {
            layers =
                Selection::parse(common.layer_selection.view(), context.where("layer_selection"));
        } catch (const InputError& e) {
            context.diagnostics().add(e);
            return nullptr;
        }
    }
    return std::make_unique<ImagerOf<Change>>(std::move(layers), std::move(change));
}

}  // namespace lightsieve
