// Shader networks to programs. See compiler.h.
#include <algorithm>

#include "render/compiler.h"

namespace lightsieve {
namespace {

/// Links followed in one chain of shaders: evaluation recurses that deep.
constexpr int kMaxShaderDepth = 128;

}  // namespace

const ShaderProgram* Compiler::program_for(const NodeInstance& node, const EventLabels& labels,
                                           int depth) {
    EventLabels wanted = labels;
    // The outermost label holds: a wrapper says what its part is called.
    if (const auto* own = node.find<Name>("label"); own != nullptr && wanted.closure.empty())
        wanted.closure = own->str();
    if (wanted.closure.find('\'') != std::string::npos) {
        if (prepared_.count(&node) == 0)
            diagnostics_.error(Code::InvalidValue,
                               "the label \"" + wanted.closure + "\" has a quote in it",
                               node.where("label"), "expressions write it between quotes: 'skin'");
        wanted.closure.clear();
    }
    const std::pair key(&node, wanted);
    if (const auto known = programs_.find(key); known != programs_.end()) return known->second;
    if (failed_shaders_.count(&node) != 0) return nullptr;
    const NodeType& type = node.type();
    if (type.output == OutputType::None) {
        failed_shaders_.insert(&node);
        diagnostics_.error(
            Code::LinkType,
            "\"" + node.name().str() + "\" is a " + type.name.str() + ", not a shader",
            node.where());
        return nullptr;
    }
    if (depth > kMaxShaderDepth) {
        failed_shaders_.insert(&node);
        diagnostics_.error(
            Code::LimitShaderDepth,
            "shaders are linked more than " + std::to_string(kMaxShaderDepth) + " deep",
            node.where(), "shorten the chain of links");
        return nullptr;
    }
    const ShaderProgram*& first = prepared_[&node];
    auto program = std::make_unique<ShaderProgram>(
        type, first != nullptr ? first->block() : static_cast<const std::byte*>(node.block()));
    ShaderProgram* out = program.get();
    out->labels = wanted;
    out->name = node.name();
    if (first != nullptr) {
        // Only labels differ: what was loaded and reported once is taken over.
        out->share_links(*first);
        link_closures(node, *out, depth);
    } else {
        link_parameters(node, *out, depth);
        link_closures(node, *out, depth);
        if (type.prepare != nullptr) {
            CompileContext context(*this, &node, node.name());
            type.prepare(out->block(), context);
        }
        prepared_[&node] = out;
    }
    out->may_be_transparent = shader_may_be_transparent(node);
    out->may_tint_shadows = shader_may_tint_shadows(node);
    out->may_scatter_inside = shader_may_scatter_inside(node);
    scene_->disperses |= shader_may_disperse(node);
    if (const auto* priority = node.find<std::int32_t>("dielectric_priority"))
        out->dielectric_priority = *priority;
    for (const ShaderProgram* part : out->parts) {
        out->may_be_transparent |= part->may_be_transparent;
        out->may_tint_shadows |= part->may_tint_shadows;
        out->dielectric_priority = std::max(out->dielectric_priority, part->dielectric_priority);
    }
    scene_->shaders.push_back(std::move(program));
    programs_[key] = out;
    return out;
}

void Compiler::link_parameters(const NodeInstance& node, ShaderProgram& program, int depth) {
    for (const Link& link : node.links()) {
        const ShaderProgram* source = program_for(*link.source, {}, depth + 1);
        if (source == nullptr) continue;
        ShaderProgram::Patch patch;
        patch.component = link.component;
        patch.source = source;
        patch.source_component = link.source_component;
        program.add_link(*link.param, link.element, patch);
    }
}

/// Shaders whose closures the node takes over carry its labels.
void Compiler::link_closures(const NodeInstance& node, ShaderProgram& program, int depth) {
    for (const ParamInfo& param : node.type().params) {
        if (param.type != ParamType::Closure || param.is_array) continue;
        auto* ref = reinterpret_cast<ShaderRef*>(program.block() + param.offset);
        if (ref->node == nullptr) continue;
        const ShaderProgram* part = program_for(*ref->node, program.labels, depth + 1);
        if (part == nullptr) continue;
        ref->program = part;
        ref->run = [](const void* shader, const ShadePoint& at, ClosureSet& out) {
            static_cast<const ShaderProgram*>(shader)->closures(at, out);
        };
        program.parts.push_back(part);
    }
}

/// By the parameter for opacity, which every shader that lets rays through has.
bool Compiler::shader_may_be_transparent(const NodeInstance& node) const {
    // A layered shader lets through what its top layer does.
    if (const auto* clear = node.find<Color>("transparency0"))
        if (!is_black(*clear) || node.is_linked("transparency0")) return true;
    for (const char* name : {"opacity", "opacity_color", "geometry_opacity"}) {
        if (node.type().find(name) == nullptr) continue;
        const auto* color = node.find<Color>(name);
        const auto* number = node.find<float>(name);
        if (node.is_linked(name) || (color != nullptr && !(*color == kWhite)) ||
            (number != nullptr && *number != 1))
            return true;
    }
    return false;
}

/// By the parameter that every shader of murky bodies has.
bool Compiler::shader_may_scatter_inside(const NodeInstance& node) {
    const auto* scattering = node.find<Color>("transmission_scatter");
    return scattering != nullptr &&
           (!is_black(*scattering) || node.is_linked("transmission_scatter"));
}

/// What ClosureSet::transmit_shadow says: transmission without caustics.
bool Compiler::shader_may_tint_shadows(const NodeInstance& node) {
    for (const char* name : {"caustics", "enable_refractive_caustics"}) {
        const auto* caustics = node.find<bool>(name);
        if (caustics != nullptr && *caustics && !node.is_linked(name)) return false;
    }
    for (const char* name : {"transmission", "transmission_weight", "Kt"}) {
        const auto* weight = node.find<float>(name);
        if (weight != nullptr && (*weight > 0 || node.is_linked(name))) return true;
    }
    return false;
}

/// What ClosureSet::disperse says: an index that depends on the wavelength.
bool Compiler::shader_may_disperse(const NodeInstance& node) {
    for (const char* name :
         {"transmission_dispersion", "transmission_dispersion_scale", "dispersion_abbe"}) {
        const auto* amount = node.find<float>(name);
        if (amount != nullptr && (*amount > 0 || node.is_linked(name))) return true;
    }
    return false;
}

/// Shapes without a shader are white clay: a lambert with its defaults.
const ShaderProgram* Compiler::default_shader(const std::string& object_label) {
    const EventLabels labels{{}, object_label};
    ShaderProgram*& made = programs_[{nullptr, labels}];
    if (made != nullptr) return made;
    const NodeType* lambert = graph_.registry().find("lambert");
    LIGHTSIEVE_ASSERT(lambert != nullptr, "the registry has no lambert");
    scene_->shaders.push_back(
        std::make_unique<ShaderProgram>(*lambert, lambert->default_block.data()));
    made = scene_->shaders.back().get();
    made->labels = labels;
    return made;
}

void Compiler::make_background() {
    const auto* ref =
        graph_.options() == nullptr ? nullptr : graph_.options()->find<NodeRef>("background");
    if (ref == nullptr || ref->node == nullptr) return;
    const ShaderProgram* program = program_for(*ref->node);
    if (program == nullptr) return;
    if (program->type().eval_value == nullptr) {
        diagnostics_.warning(
            Code::ParamPending,
            "a " + program->type().name.str() + " as background is not supported yet",
            graph_.options()->where("background"),
            "the background stays black; link a colour, an image for example");
        return;
    }
    scene_->background = program;
}

namespace {

/// What a parameter says without its links, as a colour.
Color written_color(const NodeInstance& node, Name param) {
    if (const auto* rgb = node.find<Color>(param)) return *rgb;
    if (const auto* rgba = node.find<Rgba>(param)) return rgba->rgb;
    if (const auto* number = node.find<float>(param)) return Color::grey(*number);
    return kBlack;
}

}  // namespace

ColorInput CompileContext::color_input(Name param) {
    if (node_ == nullptr) return {};
    const ParamInfo* info = node_->type().find(param);
    if (info == nullptr) return {};
    if (info->type != ParamType::Node && !node_->is_linked(param))
        return ColorInput(written_color(*node_, param));
    return compiler_.linked_color(*node_, *info);
}

ColorInput Compiler::linked_color(const NodeInstance& node, const ParamInfo& param) {
    auto color = std::make_unique<LinkedColor>();
    color->written = written_color(node, param.name);
    if (const NodeRef* named = node.find<NodeRef>(param.name)) {
        const ShaderProgram* source = *named ? program_for(*named->node) : nullptr;
        if (source == nullptr) return ColorInput(kBlack);
        ShaderProgram::Patch patch;
        patch.type = ParamType::Rgb;
        patch.source = source;
        color->links.push_back(patch);
    }
    for (const Link& link : node.links()) {
        if (link.param != &param) continue;
        const ShaderProgram* source = program_for(*link.source);
        if (source == nullptr) return ColorInput(kBlack);
        ShaderProgram::Patch patch;
        patch.type = ParamType::Rgb;
        patch.component = link.component;
        patch.source = source;
        patch.source_component = link.source_component;
        color->links.push_back(patch);
    }
    scene_->colors.push_back(std::move(color));
    return {scene_->colors.back().get(), [](const void* linked, const ShadePoint& at) {
                const auto& c = *static_cast<const LinkedColor*>(linked);
                ShaderValue out{c.written, 1};
                for (const ShaderProgram::Patch& patch : c.links)
                    ShaderProgram::apply(patch, reinterpret_cast<std::byte*>(&out.rgb), at);
                return out;
            }};
}

std::uint32_t Compiler::written_aov(Name aov) {
    const auto known = std::find(written_aovs_.begin(), written_aovs_.end(), aov);
    if (known == written_aovs_.end()) {
        written_aovs_.push_back(aov);
        return static_cast<std::uint32_t>(written_aovs_.size() - 1);
    }
    return static_cast<std::uint32_t>(known - written_aovs_.begin());
}

float Compiler::frame_number() const {
    const float* frame =
        graph_.options() == nullptr ? nullptr : graph_.options()->find<float>("frame");
    return frame == nullptr ? 1 : *frame;
}

std::vector<Name> CompileContext::user_texts(Name attribute) {
    std::set<Name> out;
    const auto add = [&](const NodeInstance& node, Name name) {
        const UserData* data = node.find_user_data(name);
        if (data == nullptr || data->type != ParamType::String || data->n == 0) return;
        for (const Name text : data->values<Name>())
            out.insert(text);
    };
    const Name by_instance("instance_" + attribute.str());
    for (const auto& scope : compiler_.graph().scopes())
        for (const auto& node : scope->nodes) {
            add(*node, attribute);
            add(*node, by_instance);
        }
    return {out.begin(), out.end()};
}

std::vector<Name> CompileContext::possible_texts(Name param) {
    const ParamInfo* info = node_ == nullptr ? nullptr : node_->type().find(param);
    if (info == nullptr) return {};
    for (const Link& link : node_->links()) {
        if (link.param != info || link.source->type().possible_texts == nullptr) continue;
        CompileContext context(compiler_, link.source, link.source->name());
        return link.source->type().possible_texts(link.source->block(), context);
    }
    return {node_->get<Name>(param)};
}

NodeContext::Frame CompileContext::frame() const {
    const RenderSettings& s = compiler_.settings();
    return {s.width, s.height, s.pixel_aspect_ratio};
}

std::unique_ptr<ShapeGeometry> CompileContext::geometry_of(NodeRef shape,
                                                           Mat4f& world_from_object) {
    if (!shape) return nullptr;
    const NodeInstance& node = *shape.node;
    if (node.type().shape_common == nullptr) {
        diagnostics().error(
            Code::LinkType,
            "\"" + node.name().str() + "\" is a " + node.type().name.str() + ", not a shape",
            where("mesh"));
        return nullptr;
    }
    const Array<Mat4f>& matrix = node.type().shape_common(node.block())->matrix;
    if (!matrix.empty()) world_from_object = matrix[0];
    world_from_object = world_from_object * outer_;
    return compiler_.geometry_of(node);
}

}  // namespace lightsieve
