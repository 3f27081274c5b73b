// cryptomatte: an aov_shader that writes ids of objects, assets, materials, and of texts of shapes.
//
// Names are cleaned and hashed before the first ray; at a hit ids are only looked up. What a shape says itself in its user
// data (crypto_object, crypto_asset, crypto_material; ..._offset: a number that is added to the name) wins over its name.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <unordered_map>
#include <vector>

#include "nodes/closure/closure_common.h"
#include "nodes/common/cryptomatte_names.h"
#include "scene/cryptomatte.h"
#include "scene/shade_services.h"

namespace lightsieve {
namespace {

constexpr std::size_t kUserMattes = 4;
constexpr std::int32_t kMaxDepth = 99;
/// Names of one manifest; as many are still read by other people's programs.
constexpr std::size_t kMaxManifest = 100000;

/// A name without its offset, ready to be hashed with one.
struct CleanName {
    std::string text;
    std::uint32_t id = 0;
};

/// What one matte needs at a hit.
struct MatteSource {
    enum class By : std::uint8_t { Object, Asset, Material, Text };
    By by = By::Object;
    std::uint32_t number = 0;
    Name text;    ///< user data that replaces the name, or is all there is
    Name offset;  ///< user data that is added to the name; empty: none
    bool any_text = false, any_offset = false;  ///< some shape has such data
    std::unordered_map<Name, CleanName> names;  ///< by the name of the shape or shader
    std::unordered_map<Name, std::uint32_t> ids_of_texts;

    [[nodiscard]] std::uint32_t id_at(const ShadePoint& at) const;
    void learn(const PlacedShape& shape, const std::vector<std::pair<Name, std::string>>& clean,
               MatteManifest& manifest);
};

std::string with_offset(std::string_view name, std::int64_t offset) {
    return offset == 0 ? std::string(name) : fmt::format("{}_{}", name, offset);
}

/// 0 if the text is none.
std::int64_t integer_of(std::string_view text) {
    std::int64_t out = 0;
    std::from_chars(text.data(), text.data() + text.size(), out);
    return out;
}

std::uint32_t MatteSource::id_at(const ShadePoint& at) const {
    const ShadeServices& services = *at.services;
    if (Name said; any_text && services.user_text(at, text, said) && !said.empty()) {
        const auto known = ids_of_texts.find(said);
        return known != ids_of_texts.end() ? known->second : matte_id(said.view());
    }
    if (by == By::Text) return 0;
    const auto known =
        names.find(by == By::Material ? services.material_name(at) : services.shape_name(at));
    if (known == names.end()) return 0;
    ShaderValue value;
    if (!any_offset || !services.user_value(at, offset, value)) return known->second.id;
    const auto added = static_cast<std::int64_t>(value.rgb.r);
    return added == 0 ? known->second.id : matte_id(with_offset(known->second.text, added));
}

/// Hashes what may be asked of a shape, and puts it into the manifest.
///
/// clean  its names (of materials there may be several) as they are and cleaned
void MatteSource::learn(const PlacedShape& shape,
                        const std::vector<std::pair<Name, std::string>>& clean,
                        MatteManifest& manifest) {
    const auto note = [&](const std::string& name) {
        const std::uint32_t id = matte_id(name);
        if (!name.empty() && manifest.size() < kMaxManifest) manifest.emplace(name, id);
        return id;
    };
    const std::vector<Name> texts = shape.at.services->user_values(shape.at, text);
    bool speaks = !texts.empty();
    for (const Name said : texts) {
        any_text = true;
        speaks = speaks && !said.empty();
        if (!said.empty()) ids_of_texts.emplace(said, note(said.str()));
    }
    if (by == By::Text) return;
    std::vector<Name> offsets = shape.at.services->user_values(shape.at, offset);
    any_offset = any_offset || !offsets.empty();
    if (offsets.empty()) offsets.emplace_back("0");
    for (const auto& [name, cleaned] : clean) {
        names.try_emplace(name, CleanName{cleaned, matte_id(cleaned)});
        if (speaks) continue;  // the name is never seen
        for (const Name added : offsets)
            note(with_offset(cleaned, integer_of(added.view())));
    }
}

struct Cryptomatte {
    bool sidecar_manifests = false;
    std::int32_t cryptomatte_depth = 6;
    bool strip_obj_namespaces = true, strip_mat_namespaces = true;
    Name aov_crypto_asset = "crypto_asset", aov_crypto_object = "crypto_object",
         aov_crypto_material = "crypto_material";
    bool preview_in_exr = false;
    bool process_maya = true, process_paths = true, process_obj_path_pipes = true,
         process_mat_path_pipes = true, process_legacy = true;
    std::array<Name, kUserMattes> user_crypto_aov, user_crypto_src;
    const std::vector<MatteSource>* sources = nullptr;  ///< made by prepare()

    static NodeType describe();
    void prepare(NodeContext& context);
    void eval(const ShadePoint& at, ClosureSet&) const {
        if (at.ray == nullptr || at.ray->mattes == nullptr || at.services == nullptr) return;
        for (const MatteSource& source : *sources)
            at.ray->mattes[source.number] = source.id_at(at);
    }

  private:
    [[nodiscard]] NameRules rules(bool strip) const {
        return {strip,
                process_maya,
                process_paths,
                process_obj_path_pipes,
                process_mat_path_pipes,
                process_legacy};
    }
};

NodeType Cryptomatte::describe() {
    using Node = Cryptomatte;
    Describe<Node> d(
        "cryptomatte", NodeKind::Shader,
        "An aov_shader that writes Cryptomatte ids of objects, assets and materials.");
    d.param("sidecar_manifests", &Node::sidecar_manifests,
            "Names go into a .json file beside each EXR file instead of its header.");
    d.param("cryptomatte_depth", &Node::cryptomatte_depth,
            "Ids that a pixel can hold, rounded up to an even number.")
        .hard_range(1, kMaxDepth);
    d.param("strip_obj_namespaces", &Node::strip_obj_namespaces,
            "Names of objects without their namespaces or paths.");
    d.param("strip_mat_namespaces", &Node::strip_mat_namespaces, "The same for materials.");
    d.param("aov_crypto_asset", &Node::aov_crypto_asset, "AOV of namespaces of objects.");
    d.param("aov_crypto_object", &Node::aov_crypto_object, "AOV of objects.");
    d.param("aov_crypto_material", &Node::aov_crypto_material, "AOV of shaders.");
    d.param("preview_in_exr", &Node::preview_in_exr,
            "EXR files hold the coloured preview, too; other files hold nothing else.");
    d.param("process_maya", &Node::process_maya, "namespace:name is understood.");
    d.param("process_paths", &Node::process_paths, "/path/to/name is understood.");
    d.param("process_obj_path_pipes", &Node::process_obj_path_pipes,
            "A pipe in a path of an object parts it like a slash.");
    d.param("process_mat_path_pipes", &Node::process_mat_path_pipes,
            "What follows a pipe in a path of a material is left out.");
    d.param("process_legacy", &Node::process_legacy,
            "Names that older exporters of Cinema 4D and Softimage wrote are understood.");
    for (std::size_t i = 0; i < kUserMattes; ++i) {
        const std::string number = std::to_string(i);
        d.part(
            "user_crypto_aov_" + number, [=](Node& n) -> Name& { return n.user_crypto_aov[i]; },
            "AOV of texts that shapes have as user data.");
        d.part(
            "user_crypto_src_" + number, [=](Node& n) -> Name& { return n.user_crypto_src[i]; },
            "Name of that user data.");
    }
    return d.done();
}

void Cryptomatte::prepare(NodeContext& context) {
    struct Wanted {
        Name aov;
        MatteSource source;
    };
    using By = MatteSource::By;
    const auto source = [](By by, Name text, Name offset) {
        MatteSource out;
        out.by = by;
        out.text = text;
        out.offset = offset;
        return out;
    };
    std::vector<Wanted> wanted{
        {aov_crypto_object, source(By::Object, "crypto_object", "crypto_object_offset")},
        {aov_crypto_asset, source(By::Asset, "crypto_asset", "crypto_asset_offset")},
        {aov_crypto_material, source(By::Material, "crypto_material", "crypto_material_offset")}};
    for (std::size_t i = 0; i < kUserMattes; ++i)
        wanted.push_back({user_crypto_src[i].empty() ? Name() : user_crypto_aov[i],
                          source(By::Text, user_crypto_src[i], {})});
    std::erase_if(wanted, [](const Wanted& w) { return w.aov.empty(); });

    std::vector<MatteManifest> manifests(wanted.size());
    const NameRules for_objects = rules(strip_obj_namespaces),
                    for_materials = rules(strip_mat_namespaces);
    context.for_each_shape([&](const PlacedShape& shape) {
        const Name name = shape.at.services->shape_name(shape.at);
        const ShapeNames names = shape_names(name.view(), for_objects);
        std::vector<std::pair<Name, std::string>> materials;
        for (const Name material : shape.materials)
            materials.emplace_back(material, material.empty()
                                                 ? "default"
                                                 : material_name(material.view(), for_materials));
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            MatteSource& to = wanted[i].source;
            if (to.by == By::Material)
                to.learn(shape, materials, manifests[i]);
            else
                to.learn(shape, {{name, to.by == By::Asset ? names.asset : names.object}},
                         manifests[i]);
        }
    });

    auto made = std::make_shared<std::vector<MatteSource>>();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        wanted[i].source.number = context.add_matte(
            {wanted[i].aov, (std::clamp(cryptomatte_depth, 1, kMaxDepth) + 1) / 2, preview_in_exr,
             sidecar_manifests, std::move(manifests[i])});
        made->push_back(std::move(wanted[i].source));
    }
    sources = made.get();
    context.keep(std::move(made));
}

}  // namespace

NodeType node_cryptomatte() { return Cryptomatte::describe(); }

}  // namespace lightsieve
