// Assignments of operators: what set_parameter does to the nodes that it selects.
//
//     visibility = 254                     numbers, also several: Kd_color = 1 0 0 or [1, 0, 0]
//     shader = 'red'                       texts and nodes, in quotes of either kind
//     base_color.r = "ramp.g"              links, components, elements (color[1] = 'checker')
//     int my_id = 3,  rgb[] tints = ...    user data, declared where a node has none of that name
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/source.h"
#include "scene/document.h"

namespace lightsieve {

struct Assignment {
    std::optional<ParamType> declared;  ///< the type that is written before the name
    bool is_array = false;              ///< `TYPE[]`
    UserDataClass user_class = UserDataClass::Constant;
    std::string param;  ///< with its suffixes
    std::string value;  ///< as a scene file would write it
};

/// Reads an assignment. What is wrong is an InputError with code operator-selection, with the column in its text.
///
/// where  the whole parameter of the operator
[[nodiscard]] Assignment parse_assignment(std::string_view text, const SourceSpan& where);

}  // namespace lightsieve
