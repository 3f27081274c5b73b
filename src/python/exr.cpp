#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <string>

#include "io/exr_rewrite.h"
#include "io/exr_tools.h"
#include "python/layers.h"
#include "python/text.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace lightsieve::python {
namespace {

std::string_view type_text(ExrPixelType type) {
    switch (type) {
        case ExrPixelType::Half: return "half";
        case ExrPixelType::UInt: return "uint";
        case ExrPixelType::Float: break;
    }
    return "float";
}

std::string_view compression_text(ExrCompression compression) {
    switch (compression) {
        case ExrCompression::None: break;
        case ExrCompression::Rle: return "rle";
        case ExrCompression::Zip: return "zip";
        case ExrCompression::Zips: return "zips";
        case ExrCompression::Piz: return "piz";
        case ExrCompression::Pxr24: return "pxr24";
        case ExrCompression::B44: return "b44";
        case ExrCompression::B44a: return "b44a";
        case ExrCompression::Dwaa: return "dwaa";
        case ExrCompression::Dwab: return "dwab";
    }
    return "none";
}

nb::dict attributes(const ExrFile& file) {
    nb::dict out;
    for (const auto& [name, value] : file.attributes)
        out[name.c_str()] = std::visit([](const auto& v) { return nb::cast(v); }, value);
    return out;
}

/// All channels of a layer interleaved: shape (height, width, channels), uint32 for UINT.
nb::object pixels(const ExrFile& file, const ExrLayer& layer) {
    const std::size_t n_channels = layer.channels.size();
    const std::size_t n_pixels =
        static_cast<std::size_t>(file.data_width) * static_cast<std::size_t>(file.data_height);
    auto* owned = new std::vector<float>(n_pixels * n_channels);
    const nb::capsule owner(owned,
                            [](void* p) noexcept { delete static_cast<std::vector<float>*>(p); });
    for (std::size_t c = 0; c < n_channels; ++c) {
        const std::vector<float>& from = file.channels[layer.channels[c]].pixels;
        for (std::size_t i = 0; i < n_pixels; ++i)
            (*owned)[i * n_channels + c] = from[i];
    }
    const std::size_t shape[3] = {static_cast<std::size_t>(file.data_height),
                                  static_cast<std::size_t>(file.data_width), n_channels};
    nb::object array = nb::cast(nb::ndarray<nb::numpy, float>(owned->data(), 3, shape, owner));
    return layer.type == ExrPixelType::UInt ? array.attr("view")("uint32") : array;
}

void add_info(nb::module_& module) {
    nb::class_<ExrLayer>(module, "ExrLayer", "One layer of an EXR file.")
        .def_ro("name", &ExrLayer::name, "`RGBA` for bare R, G, B, or what the header calls them.")
        .def_ro("suffixes", &ExrLayer::suffixes,
                "`R`, `G`, ...; empty text for a channel that is the layer.")
        .def_prop_ro(
            "type", [](const ExrLayer& l) { return type_text(l.type); },
            "`half`, `float` or `uint`.")
        .def_ro("source", &ExrLayer::source,
                "The AOV, before renaming; empty if the header does not say.")
        .def_ro("filter", &ExrLayer::filter, "Empty if the header does not say.")
        .def_ro("filter_width", &ExrLayer::filter_width, "[pixels]")
        .def_ro("expression", &ExrLayer::expression, "Light path expression; empty if none.")
        .def_ro("light_group", &ExrLayer::light_group, "Empty if none.")
        .def_ro("camera", &ExrLayer::camera, "That its output names; empty: the scene's.");
    nb::class_<ExrInfo>(module, "ExrInfo", "The header and the layers of an EXR file.")
        .def_ro("layers", &ExrInfo::layers, "The unnamed one first, then by name.")
        .def_prop_ro(
            "width", [](const ExrInfo& i) { return i.file.width; },
            "Of the display window [pixels].")
        .def_prop_ro(
            "height", [](const ExrInfo& i) { return i.file.height; },
            "Of the display window [pixels].")
        .def_prop_ro(
            "data_window",
            [](const ExrInfo& i) {
                return nb::make_tuple(i.file.data_x, i.file.data_y, i.file.data_width,
                                      i.file.data_height);
            },
            nb::sig("def data_window(self) -> tuple[int, int, int, int]"),
            "x, y, width and height, relative to the display window.")
        .def_prop_ro(
            "tiled", [](const ExrInfo& i) { return i.file.tiled; }, "Tiles, not scanlines.")
        .def_prop_ro(
            "n_parts", [](const ExrInfo& i) { return i.file.n_parts; }, "Parts of the file.")
        .def_prop_ro(
            "n_channels", [](const ExrInfo& i) { return i.file.channels.size(); },
            "Channels of all parts.")
        .def_prop_ro(
            "compression", [](const ExrInfo& i) { return compression_text(i.file.compression); },
            "As in driver_exr.compression.")
        .def_prop_ro(
            "lossy",
            [](const ExrInfo& i) {
                return std::any_of(i.file.channels.begin(), i.file.channels.end(),
                                   [&](const ExrReadChannel& c) {
                                       return loses_precision(i.file.compression, c.type);
                                   });
            },
            "The compression changes values by more than sums of layers may be off.")
        .def_prop_ro(
            "attributes", [](const ExrInfo& i) { return attributes(i.file); },
            nb::sig("def attributes(self) -> dict[str, int | float | str | list[float]]"),
            "Header attributes of the first part.");
    module.def("exr_info", &exr_info, "path"_a, "Reads a header.");
    module.def(
        "exr_read",
        [](const std::string& path) {
            const ExrFile file = read_exr(path);
            nb::list out;
            for (const ExrLayer& layer : exr_layers(file))
                out.append(nb::make_tuple(layer, pixels(file, layer)));
            return out;
        },
        "path"_a, nb::sig("def exr_read(path: str) -> list[tuple[ExrLayer, numpy.ndarray]]"),
        "Each layer with its pixels over the data window: shape (height, width, channels), row 0 "
        "at the top.");
}

using LayerPixels = nb::ndarray<const float, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

/// The channels of the layers that `pixels` has, in the places that `rewrite_exr` knows them by.
ExrChanges changes_of(const ExrInfo& info, const std::map<std::string, LayerPixels>& pixels) {
    ExrChanges changes;
    for (const ExrLayer& layer : info.layers) {
        const auto found = pixels.find(layer.name);
        if (found == pixels.end()) continue;
        const LayerPixels& from = found->second;
        const auto n = layer.channels.size();
        if (from.shape(0) != static_cast<std::size_t>(info.file.data_height) ||
            from.shape(1) != static_cast<std::size_t>(info.file.data_width) || from.shape(2) != n)
            throw nb::value_error("pixels of another shape than the layer's");
        const auto stride = static_cast<std::ptrdiff_t>(n);
        for (std::size_t c = 0; c < n; ++c)
            changes.channels[layer.channels[c]] = {from.data() + c, stride,
                                                   stride * info.file.data_width};
    }
    return changes;
}

void add_rewrite(nb::module_& module) {
    module.def(
        "exr_rewrite",
        [](const std::string& path, const std::string& output,
           const std::map<std::string, LayerPixels>& pixels,
           const std::map<std::string, std::string>& attributes) {
            ExrChanges changes = changes_of(exr_info(path), pixels);
            changes.attributes.insert(attributes.begin(), attributes.end());
            const nb::gil_scoped_release release;
            rewrite_exr(path, output, changes);
        },
        "path"_a, "output"_a, "pixels"_a, "attributes"_a,
        nb::sig("def exr_rewrite(path: str, output: str, pixels: dict[str, numpy.ndarray], "
                "attributes: dict[str, str]) -> None"),
        "Copies a file with other pixels in some layers: shape (height, width, channels) of the "
        "data window. All else stays bit for bit.");
}

void add_verify(nb::module_& module) {
    nb::class_<ExrSumCheck>(module, "ExrSumCheck", "One sum that was checked.")
        .def_ro("text", &ExrSumCheck::text, "`RGBA = diffuse + specular`")
        .def_ro("checked", &ExrSumCheck::checked, "False if it could not be: see `reason`.")
        .def_ro("passed", &ExrSumCheck::passed, "No pixel is above its tolerance.")
        .def_ro("reason", &ExrSumCheck::reason, "Why it could not be checked.")
        .def_ro("worst_x", &ExrSumCheck::worst_x,
                "Pixel with the largest residual for its tolerance.")
        .def_ro("worst_y", &ExrSumCheck::worst_y,
                "Pixel with the largest residual for its tolerance.")
        .def_ro("worst_channel", &ExrSumCheck::worst_channel, "`R`, `G` or `B`.")
        .def_ro("whole", &ExrSumCheck::whole, "The left side, there.")
        .def_ro("sum", &ExrSumCheck::sum, "The right side, there.")
        .def_ro("residual", &ExrSumCheck::residual, "Their difference.")
        .def_ro("tolerance", &ExrSumCheck::tolerance, "What is allowed there.")
        .def_ro("n_failed", &ExrSumCheck::n_failed, "Pixels above their tolerance.");
    nb::class_<ExrVerifyResult>(module, "ExrVerifyResult", "What `exr verify` found.")
        .def_ro("checks", &ExrVerifyResult::checks, "One a sum.")
        .def_prop_ro("passed", &ExrVerifyResult::passed,
                     "Something was checked, and all of it passed.");
    module.def("exr_verify", &exr_verify, "path"_a, nb::call_guard<nb::gil_scoped_release>(),
               "Re-checks the sums that the header names.");
}

void add_diff(nb::module_& module) {
    nb::class_<ExrLayerDiff>(module, "ExrLayerDiff", "How one layer of two files differs.")
        .def_ro("name", &ExrLayerDiff::name, "The layer.")
        .def_ro("n_values", &ExrLayerDiff::n_values, "Compared: pixels times channels.")
        .def_ro("n_different", &ExrLayerDiff::n_different, "Not the same value.")
        .def_ro("n_nonfinite", &ExrLayerDiff::n_nonfinite,
                "NaN or infinite in either file, left out of the figures.")
        .def_ro("rmse", &ExrLayerDiff::rmse, "Root of the mean squared difference.")
        .def_ro("relative_mse", &ExrLayerDiff::relative_mse, "Mean of (a-b)^2 / (b^2 + 0.01).")
        .def_ro("max_difference", &ExrLayerDiff::max_difference, "Largest difference.")
        .def_ro("max_x", &ExrLayerDiff::max_x, "Pixel of the largest difference.")
        .def_ro("max_y", &ExrLayerDiff::max_y, "Pixel of the largest difference.");
    nb::class_<ExrDiffResult>(module, "ExrDiffResult", "How two files differ.")
        .def_ro("layers", &ExrDiffResult::layers, "Those that both have.")
        .def_ro("only_a", &ExrDiffResult::only_a, "Names of layers.")
        .def_ro("only_b", &ExrDiffResult::only_b, "Names of layers.");
    module.def("exr_diff", &exr_diff, "a"_a, "b"_a, "picture"_a = "", "layer"_a = "",
               nb::call_guard<nb::gil_scoped_release>(),
               "Compares a with the reference b; `picture` gets the absolute difference.");
}

}  // namespace

void add_exr(nb::module_& module) {
    add_info(module);
    add_rewrite(module);
    add_verify(module);
    add_diff(module);
}

}  // namespace lightsieve::python
