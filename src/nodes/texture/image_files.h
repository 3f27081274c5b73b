// The files that one image node may show: a name with tokens stands for several.
//
//     <udim>              1001 + floor(u) + 10 floor(v): one file a unit square of texture coordinates
//     <tile>, <uvtile>    the same as _uU_vV and uU_vV, counted from 1
//     <frame>, <frame:04> options.frame, as a number or with that many digits
//     <attr:NAME default:TEXT>, <attr:NAME>   user data of the shape
//
// Every file is found and opened before rendering; a look-up chooses by the shape's user data and the coordinates.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/texture.h"
#include "scene/node_context.h"

namespace lightsieve {

/// The tiles of one name; no tile: one file for all.
struct ImageTiles {
    bool tiled = false;
    const Texture* single = nullptr;
    std::map<std::int32_t, const Texture*> tiles;  ///< by udim

    [[nodiscard]] bool empty() const { return single == nullptr && tiles.empty(); }
};

struct ImageFiles {
    Name attribute;  ///< user data that chooses; empty: the file name does
    std::map<const void*, ImageTiles> by_text;  ///< by Name::id of the user data, or of the name
    ImageTiles fallback;                        ///< for other texts
};

/// A number within a file name: options.frame for <frame> and <frame:DIGITS>.
[[nodiscard]] std::string with_frame(const std::string& name, float frame);

/// One found token `<WORD...>`: where it starts and ends, what stands after the word's colon.
struct FileToken {
    std::size_t begin = 0, end = 0;
    std::string rest;
};
/// The first token of that word, in any case; `found` false if there is none.
[[nodiscard]] FileToken find_token(const std::string& name, std::string_view word, bool& found);

/// Opens every file of a name whose tokens but those of tiles have been replaced.
[[nodiscard]] ImageTiles open_tiles(const std::string& name, std::string_view color_space,
                                    NodeContext& context);

}  // namespace lightsieve
