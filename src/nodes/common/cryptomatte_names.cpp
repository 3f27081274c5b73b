#include "nodes/common/cryptomatte_names.h"

#include <algorithm>

namespace lightsieve {
namespace {

constexpr auto kNone = std::string_view::npos;
constexpr std::string_view kSoftimage = ".SItoA.", kCinema = "c4d|";
constexpr NameRules kNoRules{false, false, false, false, false, false};

/// Takes the namespace off every part of a Maya path: "a:b|a:c" becomes "b|c".
std::string without_maya_namespaces(std::string_view name) {
    std::string out;
    while (true) {
        const std::size_t end = std::min(name.find('|'), name.size());
        const std::string_view part = name.substr(0, end);
        const std::size_t colon = part.find(':');
        out += colon == kNone ? part : part.substr(colon + 1);
        if (end == name.size()) return out;
        out += '|';
        name.remove_prefix(end + 1);
    }
}

/// The object of a Softimage instance, "cloud.SItoA.Instance.1.7 tree.SItoA.2000": "tree". Empty if it is none.
std::string_view softimage_instance(std::string_view name) {
    const std::size_t begin = name.find(".SItoA.Instance.");
    if (begin == kNone) return {};
    const std::size_t blank = name.find(' ', begin);
    if (blank == kNone) return {};
    name.remove_prefix(blank + 1);
    const std::size_t end = name.find(kSoftimage);
    return end == kNone ? std::string_view{} : name.substr(0, end);
}

/// Both names, parted at a place of the text, which belongs to neither.
ShapeNames parted(std::string_view name, std::size_t at, bool strip) {
    if (at == kNone) return {std::string(name), "default"};
    const std::string_view before = name.substr(0, at);
    return {std::string(strip ? name.substr(at + 1) : name),
            before.empty() ? "default" : std::string(before)};
}

std::string softimage_material(std::string_view name, bool strip) {
    name = name.substr(0, name.find(kSoftimage));
    // The last part is the shader, the one before it may be a group of mattes.
    name = name.substr(0, name.rfind('.'));
    name = name.substr(0, name.find(".Standard_Mattes"));
    constexpr std::string_view kPrefix = "Sources.Materials.";
    if (const std::size_t at = name.find(kPrefix); at != kNone)
        name.remove_prefix(at + kPrefix.size());
    if (const std::size_t library = name.find('.'); strip && library != kNone)
        name.remove_prefix(library + 1);
    return std::string(name);
}

}  // namespace

ShapeNames shape_names(std::string_view name, const NameRules& rules) {
    const bool strip = rules.strip_namespaces;
    if (rules == kNoRules) return {std::string(name), "default"};
    if (name.starts_with('/')) {
        if (!rules.paths) return {std::string(name), "default"};
        return parted(name, name.find_last_of(rules.pipes_in_paths ? "/|" : "/"), strip);
    }
    if (rules.legacy && name.starts_with(kCinema)) {
        name.remove_prefix(kCinema.size());
        return parted(name, name.rfind('|'), strip);
    }
    if (const std::size_t suffix = name.find(kSoftimage); rules.legacy && suffix != kNone) {
        const std::string_view shown = name.substr(0, suffix);
        ShapeNames out = parted(shown, shown.find('.'), strip);
        if (const std::string_view placed = softimage_instance(name); !placed.empty())
            out.object = placed;
        return out;
    }
    if (!rules.maya) return {std::string(name), "default"};
    ShapeNames out = parted(name, name.find(':'), strip);
    if (strip) out.object = without_maya_namespaces(name);
    return out;
}

std::string material_name(std::string_view name, const NameRules& rules) {
    const bool strip = rules.strip_namespaces;
    if (rules == kNoRules) return std::string(name);
    if (rules.paths && name.starts_with('/')) {
        if (rules.material_pipes) name = name.substr(0, name.find('|'));
        return std::string(strip ? name.substr(name.rfind('/') + 1) : name);
    }
    if (rules.legacy && name.starts_with(kCinema)) {
        name.remove_prefix(kCinema.size());
        return std::string(name.substr(0, name.find('|')));
    }
    if (const std::size_t colon = name.find(':'); rules.maya && strip && colon != kNone)
        return std::string(name.substr(colon + 1));
    if (rules.legacy && name.find(kSoftimage) != kNone) return softimage_material(name, strip);
    return std::string(name);
}

}  // namespace lightsieve
