#include "nodes/texture/image_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace lightsieve {
namespace {

/// Tiles that a name may have: ten across, as many up.
constexpr std::int32_t kTilesAcross = 10, kTilesUp = 10, kFirstUdim = 1001;

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

}  // namespace

FileToken find_token(const std::string& name, std::string_view word, bool& found) {
    const std::string small = lower(name);
    found = false;
    for (std::size_t at = small.find('<'); at != std::string::npos; at = small.find('<', at + 1)) {
        const std::size_t end = small.find('>', at);
        if (end == std::string::npos) break;
        const std::string inside = small.substr(at + 1, end - at - 1);
        if (inside != word && !inside.starts_with(std::string(word) + ':')) continue;
        found = true;
        FileToken out{at, end + 1, {}};
        if (inside.size() > word.size())
            out.rest = name.substr(at + word.size() + 2, end - at - word.size() - 2);
        return out;
    }
    return {};
}

std::string with_frame(const std::string& name, float frame) {
    bool found = false;
    const FileToken token = find_token(name, "frame", found);
    if (!found) return name;
    const auto digits = token.rest.empty() ? 0 : std::clamp(std::atoi(token.rest.c_str()), 0, 16);
    const auto number = static_cast<long>(std::isfinite(frame) ? std::floor(frame) : 0);
    return name.substr(0, token.begin) + fmt::format("{:0{}}", number, digits) +
           name.substr(token.end);
}

ImageTiles open_tiles(const std::string& name, std::string_view color_space,
                      NodeContext& context) {
    ImageTiles out;
    bool udim = false, tile = false, uvtile = false;
    FileToken token = find_token(name, "udim", udim);
    if (!udim) token = find_token(name, "tile", tile);
    if (!udim && !tile) token = find_token(name, "uvtile", uvtile);
    const auto open = [&](const std::string& file) -> const Texture* {
        const std::optional<std::string> path = context.find_asset(file);
        if (!path) return nullptr;
        return context.textures().open(*path, color_space, context.diagnostics(),
                                       context.where("filename"));
    };
    out.tiled = udim || tile || uvtile;
    if (!out.tiled) {
        out.single = open(name);
        return out;
    }
    for (std::int32_t v = 0; v < kTilesUp; ++v)
        for (std::int32_t u = 0; u < kTilesAcross; ++u) {
            const std::int32_t number = kFirstUdim + u + 10 * v;
            const std::string text = udim
                                         ? std::to_string(number)
                                         : fmt::format("{}u{}_v{}", tile ? "_" : "", u + 1, v + 1);
            const std::string file = name.substr(0, token.begin) + text + name.substr(token.end);
            if (const Texture* texture = open(file)) out.tiles[number] = texture;
        }
    return out;
}

}  // namespace lightsieve
