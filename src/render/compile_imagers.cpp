// Chains of imagers: driver.input, or options.imager for drivers without one.
#include "render/compiler.h"
#include "render/imaging.h"

namespace lightsieve {

/// Written from the last one that acts to the first, made in the order in which they act. The graph has no circles.
Imagers Compiler::make_imagers(const NodeInstance* last) {
    Imagers out;
    std::vector<const NodeInstance*> chain;
    for (const NodeInstance* node = last; node != nullptr;) {
        if (node->type().make_imager == nullptr) {
            diagnostics_.warning(
                Code::WrongType,
                "\"" + node->name().str() + "\" is no imager but a " + node->type().name.str(),
                node->where(), "pictures are written without it");
            break;
        }
        chain.push_back(node);
        const NodeRef* input = node->find<NodeRef>("input");
        node = input != nullptr ? input->node : nullptr;
    }
    for (auto node = chain.rbegin(); node != chain.rend(); ++node) {
        CompileContext context(*this, *node, (*node)->name());
        if (auto imager = (*node)->type().make_imager((*node)->block(), context))
            out.push_back(std::move(imager));
    }
    return out;
}

void Compiler::attach_imagers(PlannedDriver& planned) {
    if (planned.driver == nullptr || option<bool>("ignore_imagers", false)) return;
    const NodeRef* own = planned.node != nullptr ? planned.node->find<NodeRef>("input") : nullptr;
    const NodeInstance* last = own != nullptr ? own->node : nullptr;
    if (last == nullptr) last = option<NodeRef>("imager", {}).node;
    Imagers imagers = make_imagers(last);
    if (imagers.empty()) return;
    if (planned.driver->deep()) {
        diagnostics_.warning(Code::ParamPending, "imagers do not change deep pixels",
                             last->where(), "use driver_exr for the corrected picture");
        return;
    }
    auto imaging = std::make_unique<ImagingDriver>(std::move(planned.driver), std::move(imagers));
    for (const std::uint32_t index : planned.layers) {
        PlannedLayer& layer = scene_->plan.layers[index];
        layer.imaged = imaging->changes(layer.info);
    }
    planned.driver = std::move(imaging);
}

}  // namespace lightsieve
