// Shaders that write AOVs beside every surface, and what those of them that write mattes must know of the scene.
#include <algorithm>
#include <set>
#include <tuple>

#include "render/compiler.h"
#include "render/shade_services.h"

namespace lightsieve {
namespace {

/// Mattes that a scene may ask for without a shader that writes them.
constexpr std::array<std::string_view, 3> kDefaultMattes{"crypto_object", "crypto_asset",
                                                         "crypto_material"};

/// Whether an output string names one of them, or a layer of it.
bool names_default_matte(std::string_view output) {
    return std::any_of(kDefaultMattes.begin(), kDefaultMattes.end(), [&](std::string_view name) {
        const std::size_t at = output.find(name);
        return at == 0 || (at != std::string_view::npos && output[at - 1] == ' ');
    });
}

/// Instances of a lineage differ if an instancer on the way has user data for each.
bool differs_by_instance(const Lineage& lineage) {
    return std::any_of(lineage.begin(), lineage.end(),
                       [](const LineageStep& step) { return !step.by_instance.empty(); });
}

}  // namespace

void Compiler::make_aov_shaders() {
    const auto* refs = graph_.options() == nullptr
                           ? nullptr
                           : graph_.options()->find<Array<NodeRef>>("aov_shaders");
    if (refs != nullptr)
        for (const NodeRef& ref : refs->first_key())
            if (const ShaderProgram* program = ref ? program_for(*ref.node) : nullptr)
                scene_->aov_shaders.push_back(program);
    if (!scene_->plan.mattes.empty() || !wants_default_mattes()) return;
    const NodeType* type = graph_.registry().find("cryptomatte");
    LIGHTSIEVE_ASSERT(type != nullptr, "the registry has no cryptomatte");
    auto program = std::make_unique<ShaderProgram>(*type, type->default_block.data());
    CompileContext context(*this, nullptr, "cryptomatte");
    type->prepare(program->block(), context);
    scene_->aov_shaders.push_back(program.get());
    scene_->shaders.push_back(std::move(program));
}

/// Outputs that ask for mattes which no shader of the scene writes get one with its defaults.
bool Compiler::wants_default_mattes() const {
    for (const std::string& aov : options_.aovs)
        if (names_default_matte(aov)) return true;
    const auto* outputs =
        graph_.options() == nullptr ? nullptr : graph_.options()->find<Array<Name>>("outputs");
    if (outputs == nullptr) return false;
    const auto texts = outputs->first_key();
    return std::any_of(texts.begin(), texts.end(),
                       [](Name text) { return names_default_matte(text.view()); });
}

std::uint32_t Compiler::add_matte(const NodeInstance* by, const Matte& matte) {
    if (!shapes_are_known_)
        diagnostics_.warning(
            Code::ParamPending, "mattes are written by shaders of options.aov_shaders only",
            by != nullptr ? by->where() : SourceSpan{},
            "put the shader there, and nowhere else: it does not have to be linked to surfaces");
    std::vector<Matte>& mattes = scene_->plan.mattes;
    const auto known = std::find_if(mattes.begin(), mattes.end(),
                                    [&](const Matte& m) { return m.name == matte.name; });
    if (known == mattes.end()) {
        mattes.push_back(matte);
        return static_cast<std::uint32_t>(mattes.size() - 1);
    }
    known->manifest.insert(matte.manifest.begin(), matte.manifest.end());
    return static_cast<std::uint32_t>(known - mattes.begin());
}

void Compiler::for_each_shape(const std::function<void(const PlacedShape&)>& body) const {
    std::set<std::tuple<const void*, const Lineage*, const void*>> seen;
    for (const SceneObject& object : scene_->objects) {
        const bool is_new =
            seen.insert({object.name.id(), object.lineage, object.shaders.data()}).second;
        if (!is_new && !differs_by_instance(*object.lineage)) continue;
        PlacedShape shape;
        shape.at.shape = &object;
        shape.at.services = scene_->services.get();
        for (const ShaderProgram* program : object.shaders)
            shape.materials.push_back(program->name);
        body(shape);
    }
}

}  // namespace lightsieve
