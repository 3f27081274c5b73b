#include "io/exr_tools.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>

#include "core/diagnostics.h"
#include "core/error.h"
#include "io/image_write.h"

namespace lightsieve {

namespace {

constexpr const char* kAovPrefix = "arnold/aovs/";

std::string text_attribute(const ExrFile& file, const std::string& name) {
    const auto it = file.attributes.find(name);
    const std::string* text =
        it == file.attributes.end() ? nullptr : std::get_if<std::string>(&it->second);
    return text == nullptr ? std::string() : *text;
}

float float_attribute(const ExrFile& file, const std::string& name) {
    const auto it = file.attributes.find(name);
    const float* value = it == file.attributes.end() ? nullptr : std::get_if<float>(&it->second);
    return value == nullptr ? 0 : *value;
}

/// Layers that the header describes.
std::set<std::string> described_layers(const ExrFile& file) {
    std::set<std::string> names;
    const std::string prefix = kAovPrefix;
    for (const auto& [name, value] : file.attributes) {
        const std::size_t end = name.rfind('/');
        if (name.starts_with(prefix) && end >= prefix.size())
            names.insert(name.substr(prefix.size(), end - prefix.size()));
    }
    return names;
}

bool is_bare_color(const std::string& channel) {
    return channel == "R" || channel == "G" || channel == "B" || channel == "A";
}

/// What bare R, G, B, A are called: what the header describes and no channel is named after, else "RGBA".
std::string bare_layer_name(const ExrFile& file) {
    std::set<std::string> names = described_layers(file);
    for (const ExrReadChannel& c : file.channels)
        names.erase(c.name.substr(0, c.name.rfind('.')));
    if (names.contains("RGBA") || names.empty()) return "RGBA";
    return *names.begin();
}

/// R G B A and X Y Z in this order, others after them.
std::size_t suffix_rank(const std::string& suffix) {
    const std::size_t at = std::string("RGBAXYZ").find(suffix);
    return suffix.size() == 1 && at != std::string::npos ? at : 99;
}

void describe(const ExrFile& file, ExrLayer& layer) {
    const std::string prefix = kAovPrefix + layer.name + "/";
    layer.type = file.channels[layer.channels[0]].type;
    layer.source = text_attribute(file, prefix + "source");
    layer.filter = text_attribute(file, prefix + "filter");
    layer.filter_width = float_attribute(file, prefix + "filter_width");
    layer.expression = text_attribute(file, prefix + "lpe_expression");
    layer.light_group = text_attribute(file, prefix + "light_group");
    layer.camera = text_attribute(file, prefix + "camera");
}

void sort_channels(ExrLayer& layer) {
    std::vector<std::size_t> order(layer.channels.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(suffix_rank(layer.suffixes[a]), layer.suffixes[a]) <
               std::pair(suffix_rank(layer.suffixes[b]), layer.suffixes[b]);
    });
    ExrLayer sorted = layer;
    for (std::size_t i = 0; i < order.size(); ++i) {
        sorted.channels[i] = layer.channels[order[i]];
        sorted.suffixes[i] = layer.suffixes[order[i]];
    }
    layer = std::move(sorted);
}

std::vector<std::string> split(const std::string& text, const std::string& separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end = text.find(separator); end != std::string::npos;
         end = text.find(separator, begin)) {
        parts.push_back(text.substr(begin, end - begin));
        begin = end + separator.size();
    }
    parts.push_back(text.substr(begin));
    return parts;
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> out;
    for (std::string& line : split(text, "\n")) {
        if (!line.empty()) out.push_back(std::move(line));
    }
    return out;
}

const ExrLayer* find_layer(const std::vector<ExrLayer>& layers, const std::string& name) {
    const auto it = std::find_if(layers.begin(), layers.end(),
                                 [&](const ExrLayer& l) { return l.name == name; });
    if (it != layers.end()) return &*it;
    // The beauty goes by several names.
    if (name == "beauty" || name == "RGBA" || name == "RGB") {
        for (const ExrLayer& layer : layers) {
            if (layer.name == "RGBA" || layer.name == "RGB" || layer.source == "RGBA" ||
                layer.source == "RGB") {
                if (layer.light_group.empty()) return &layer;
            }
        }
    }
    return nullptr;
}

const std::vector<float>* channel_of(const ExrFile& file, const ExrLayer& layer,
                                     const std::string& suffix) {
    for (std::size_t i = 0; i < layer.channels.size(); ++i) {
        if (layer.suffixes[i] == suffix) return &file.channels[layer.channels[i]].pixels;
    }
    return nullptr;
}

/// The layers of one sum; the first is the whole.
struct Sum {
    std::vector<const ExrLayer*> layers;
    std::string problem;  ///< why it cannot be checked
};

Sum find_sum(const ExrFile& file, const std::vector<ExrLayer>& layers, const std::string& whole,
             const std::vector<std::string>& parts) {
    Sum sum;
    std::vector<std::string> names = {whole};
    names.insert(names.end(), parts.begin(), parts.end());
    for (const std::string& name : names) {
        const ExrLayer* layer = find_layer(layers, name);
        if (layer == nullptr) return {{}, "the file has no layer \"" + name + "\""};
        const ExrLayer* first = sum.layers.empty() ? layer : sum.layers[0];
        if (layer->filter != first->filter || layer->filter_width != first->filter_width)
            return {{},
                    "\"" + name + "\" went through another filter than \"" + first->name + "\""};
        if (loses_precision(file.compression, layer->type))
            return {{}, "the file's compression loses precision"};
        sum.layers.push_back(layer);
    }
    return sum;
}

/// Checks one channel over all pixels and keeps the worst one. worst: its residual over its tolerance; below 0 at first.
void check_channel(const ExrFile& file, const Sum& sum, const std::string& suffix,
                   ExrSumCheck& check, double& worst) {
    std::vector<const std::vector<float>*> planes;
    bool half = false;
    for (const ExrLayer* layer : sum.layers) {
        const std::vector<float>* plane = channel_of(file, *layer, suffix);
        if (plane == nullptr) return;
        planes.push_back(plane);
        half = half || layer->type == ExrPixelType::Half;
    }
    const double relative = half ? kHalfSumTolerance : kFloatSumTolerance;
    // Below the normal numbers rounding is absolute: half a step of the smallest one for each layer.
    const double absolute = static_cast<double>(planes.size()) * (half ? 0x1p-25 : 0x1p-126);
    check.checked = true;
    for (std::size_t i = 0; i < planes[0]->size(); ++i) {
        const double whole = double{(*planes[0])[i]};
        double total = 0, magnitude = 0;
        for (std::size_t p = 1; p < planes.size(); ++p) {
            total += double{(*planes[p])[i]};
            magnitude += std::abs(double{(*planes[p])[i]});
        }
        const double residual = std::abs(whole - total),
                     tolerance = relative * magnitude + absolute;
        const bool failed = !(residual <= tolerance);  // also if something is not a number
        if (failed) ++check.n_failed;
        const double severity =
            std::isfinite(residual) && std::isfinite(tolerance) ? residual / tolerance : INFINITY;
        if (severity <= worst) continue;
        worst = severity;
        check.worst_x =
            file.data_x + static_cast<int>(i % static_cast<std::size_t>(file.data_width));
        check.worst_y =
            file.data_y + static_cast<int>(i / static_cast<std::size_t>(file.data_width));
        check.worst_channel = suffix.empty() ? sum.layers[0]->name : suffix;
        check.whole = whole;
        check.sum = total;
        check.residual = residual;
        check.tolerance = tolerance;
    }
}

ExrSumCheck check_sum(const ExrFile& file, const std::vector<ExrLayer>& layers,
                      const std::string& text, const std::string& whole,
                      const std::vector<std::string>& parts) {
    ExrSumCheck check;
    check.text = text;
    const Sum sum = find_sum(file, layers, whole, parts);
    if (!sum.problem.empty()) {
        check.reason = sum.problem;
        return check;
    }
    // Alpha is no light: it does not add up.
    double worst = -1;
    for (const char* suffix : {"R", "G", "B", ""})
        check_channel(file, sum, suffix, check, worst);
    if (!check.checked) check.reason = "the layers have no channel in common";
    check.passed = check.checked && check.n_failed == 0;
    return check;
}

/// Index of frame pixel (x, y) in a file's channels, or nothing outside of its data window.
bool locate(const ExrFile& file, int x, int y, std::size_t& index) {
    const int column = x - file.data_x, row = y - file.data_y;
    if (column < 0 || row < 0 || column >= file.data_width || row >= file.data_height)
        return false;
    index = static_cast<std::size_t>(row) * static_cast<std::size_t>(file.data_width) +
            static_cast<std::size_t>(column);
    return true;
}

/// Figures that are divided by the number of values at the end.
struct DiffSums {
    double squared = 0, relative = 0;
    std::size_t n_finite = 0;
};

void add_difference(const ExrFile& file, double a, double b, std::size_t i, ExrLayerDiff& diff,
                    DiffSums& sums) {
    ++diff.n_values;
    const bool same = a == b || (std::isnan(a) && std::isnan(b));
    if (!same) ++diff.n_different;
    if (!std::isfinite(a) || !std::isfinite(b)) {
        ++diff.n_nonfinite;
        return;
    }
    const double d = a - b;
    ++sums.n_finite;
    sums.squared += d * d;
    sums.relative += d * d / (b * b + kRelativeMseEpsilon);
    if (std::abs(d) <= diff.max_difference) return;
    diff.max_difference = std::abs(d);
    diff.max_x = file.data_x + static_cast<int>(i % static_cast<std::size_t>(file.data_width));
    diff.max_y = file.data_y + static_cast<int>(i / static_cast<std::size_t>(file.data_width));
}

double value_of(const ExrReadChannel& channel, std::size_t i) {
    return channel.type == ExrPixelType::UInt
               ? static_cast<double>(std::bit_cast<std::uint32_t>(channel.pixels[i]))
               : double{channel.pixels[i]};
}

/// Compares the channels that both layers have; what is outside of a's data window counts as 0.
ExrLayerDiff diff_layer(const ExrFile& a, const ExrLayer& layer_a, const ExrFile& b,
                        const ExrLayer& layer_b,
                        std::map<std::string, std::vector<float>>& pictures) {
    ExrLayerDiff diff;
    diff.name = layer_b.name;
    DiffSums sums;
    for (std::size_t c = 0; c < layer_b.channels.size(); ++c) {
        const auto same =
            std::find(layer_a.suffixes.begin(), layer_a.suffixes.end(), layer_b.suffixes[c]);
        if (same == layer_a.suffixes.end()) continue;
        const ExrReadChannel& channel_a =
            a.channels[layer_a
                           .channels[static_cast<std::size_t>(same - layer_a.suffixes.begin())]];
        const ExrReadChannel& channel_b = b.channels[layer_b.channels[c]];
        std::vector<float>& picture = pictures[channel_b.name];
        picture.assign(channel_b.pixels.size(), 0);
        for (std::size_t i = 0; i < channel_b.pixels.size(); ++i) {
            std::size_t at = 0;
            const int x = b.data_x + static_cast<int>(i % static_cast<std::size_t>(b.data_width)),
                      y = b.data_y + static_cast<int>(i / static_cast<std::size_t>(b.data_width));
            const double value_a = locate(a, x, y, at) ? value_of(channel_a, at) : 0,
                         value_b = value_of(channel_b, i);
            add_difference(b, value_a, value_b, i, diff, sums);
            picture[i] = static_cast<float>(std::abs(value_a - value_b));
        }
    }
    const double n = static_cast<double>(std::max<std::size_t>(1, sums.n_finite));
    diff.rmse = std::sqrt(sums.squared / n);
    diff.relative_mse = sums.relative / n;
    return diff;
}

/// |a - b| of every channel as an EXR file.
void write_exr_picture(const std::string& path, const ExrFile& b,
                       const std::map<std::string, std::vector<float>>& pictures) {
    ExrWriteSpec spec;
    spec.width = b.width;
    spec.height = b.height;
    spec.data_x = b.data_x;
    spec.data_y = b.data_y;
    spec.data_width = b.data_width;
    spec.data_height = b.data_height;
    spec.tiled = false;
    spec.parts.push_back({"", {}});
    std::vector<ExrPlane> planes;
    for (const auto& [name, pixels] : pictures) {
        spec.parts[0].channels.push_back({name, ExrPixelType::Float});
        planes.push_back({pixels.data(), 1, b.data_width});
    }
    ExrWriter writer(path, spec);
    writer.write(b.data_x, b.data_y, b.data_width, b.data_height, planes);
    writer.close();
}

/// |a - b| of one layer as a picture, shown as light (sRGB).
void write_display_picture(const std::string& path, const ExrFile& b, const ExrLayer& layer,
                           const std::map<std::string, std::vector<float>>& pictures) {
    std::vector<const std::vector<float>*> planes;
    for (std::size_t c = 0; c < layer.channels.size() && planes.size() < 3; ++c) {
        const auto it = pictures.find(b.channels[layer.channels[c]].name);
        if (it != pictures.end() && layer.suffixes[c] != "A") planes.push_back(&it->second);
    }
    if (planes.size() == 2 || planes.empty())
        planes.resize(1, planes.empty() ? &pictures.begin()->second : planes[0]);
    PictureSpec spec;
    spec.width = b.data_width;
    spec.height = b.data_height;
    spec.n_channels = static_cast<int>(planes.size());
    spec.format = path.ends_with(".png") ? PictureFormat::Png : PictureFormat::Tiff;
    std::vector<float> pixels;
    pixels.reserve(planes[0]->size() * planes.size());
    for (std::size_t i = 0; i < planes[0]->size(); ++i) {
        for (const std::vector<float>* plane : planes)
            pixels.push_back(encode(Transfer::Srgb, (*plane)[i]));
    }
    write_picture(path, spec, pixels);
}

std::vector<std::string> layer_names(const std::vector<ExrLayer>& layers) {
    std::vector<std::string> names;
    for (const ExrLayer& layer : layers)
        names.push_back(layer.name);
    return names;
}

void write_difference(const std::string& path, const std::string& layer, const ExrFile& b,
                      const std::vector<ExrLayer>& layers, const ExrDiffResult& result,
                      const std::map<std::string, std::vector<float>>& pictures) {
    if (pictures.empty())
        throw InputError(
            Error{Code::UnknownLayer,
                  "the files have no layer in common: there is no difference to write",
                  {},
                  "compare files of the same layers",
                  {},
                  Severity::Error});
    if (path.ends_with(".exr")) return write_exr_picture(path, b, pictures);
    if (!path.ends_with(".png") && !path.ends_with(".tif") && !path.ends_with(".tiff")) {
        throw InputError(Error{Code::FileUnwritable,
                               "cannot write \"" + path + "\": no format has that ending",
                               {},
                               "use .exr, .png or .tif",
                               {},
                               Severity::Error});
    }
    const std::string& name = layer.empty() ? result.layers.front().name : layer;
    const ExrLayer* shown = find_layer(layers, name);
    const bool common = shown != nullptr &&
                        std::any_of(result.layers.begin(), result.layers.end(),
                                    [&](const ExrLayerDiff& d) { return d.name == shown->name; });
    if (!common)
        throw InputError(Error{Code::UnknownLayer,
                               "the files have no common layer \"" + name + "\"",
                               {},
                               did_you_mean(name, layer_names(layers)),
                               {},
                               Severity::Error});
    write_display_picture(path, b, *shown, pictures);
}

}  // namespace

std::vector<ExrLayer> exr_layers(const ExrFile& file) {
    const std::string bare = bare_layer_name(file);
    std::map<std::string, ExrLayer> by_name;
    for (std::size_t i = 0; i < file.channels.size(); ++i) {
        const std::string& name = file.channels[i].name;
        const std::size_t dot = name.rfind('.');
        const bool whole = dot == std::string::npos && !is_bare_color(name);
        const std::string layer_name = dot != std::string::npos ? name.substr(0, dot)
                                       : whole                  ? name
                                                                : bare;
        ExrLayer& layer = by_name[layer_name];
        layer.name = layer_name;
        layer.channels.push_back(i);
        layer.suffixes.push_back(dot != std::string::npos ? name.substr(dot + 1)
                                 : whole                  ? ""
                                                          : name);
    }
    std::vector<ExrLayer> layers;
    for (auto& [name, layer] : by_name) {
        sort_channels(layer);
        describe(file, layer);
        const bool first = name == bare && is_bare_color(file.channels[layer.channels[0]].name);
        layers.insert(first ? layers.begin() : layers.end(), std::move(layer));
    }
    return layers;
}

ExrInfo exr_info(const std::string& path) {
    ExrInfo info;
    info.file = read_exr_header(path);
    info.layers = exr_layers(info.file);
    return info;
}

bool ExrVerifyResult::passed() const {
    bool any = false;
    for (const ExrSumCheck& check : checks) {
        if (check.checked && !check.passed) return false;
        any = any || check.checked;
    }
    return any;
}

ExrVerifyResult exr_verify(const std::string& path) {
    const ExrFile file = read_exr(path);
    const std::vector<ExrLayer> layers = exr_layers(file);
    ExrVerifyResult result;
    for (const std::string& text : lines(text_attribute(file, "lightsieve/partitions"))) {
        const std::vector<std::string> sides = split(text, " = ");
        if (sides.size() != 2) {
            ExrSumCheck unreadable;
            unreadable.text = text;
            unreadable.reason = "it is not of the form \"whole = part + part\"";
            result.checks.push_back(std::move(unreadable));
            continue;
        }
        result.checks.push_back(check_sum(file, layers, text, sides[0], split(sides[1], " + ")));
    }
    return result;
}

ExrDiffResult exr_diff(const std::string& path_a, const std::string& path_b,
                       const std::string& picture, const std::string& layer) {
    const ExrFile a = read_exr(path_a), b = read_exr(path_b);
    if (a.width != b.width || a.height != b.height) {
        const auto size = [](const ExrFile& f) {
            return std::to_string(f.width) + "x" + std::to_string(f.height);
        };
        throw InputError(
            Error{Code::PictureSize,
                  "\"" + path_a + "\" has " + size(a) + " pixels, \"" + path_b + "\" " + size(b),
                  {},
                  "render both at one size",
                  {},
                  Severity::Error});
    }
    const std::vector<ExrLayer> layers_a = exr_layers(a), layers_b = exr_layers(b);
    ExrDiffResult result;
    std::map<std::string, std::vector<float>> pictures;
    for (const ExrLayer& layer_b : layers_b) {
        const auto same = std::find_if(layers_a.begin(), layers_a.end(),
                                       [&](const ExrLayer& l) { return l.name == layer_b.name; });
        if (same == layers_a.end()) {
            result.only_b.push_back(layer_b.name);
            continue;
        }
        result.layers.push_back(diff_layer(a, *same, b, layer_b, pictures));
    }
    for (const ExrLayer& layer_a : layers_a) {
        const auto same = std::find_if(layers_b.begin(), layers_b.end(),
                                       [&](const ExrLayer& l) { return l.name == layer_a.name; });
        if (same == layers_b.end()) result.only_a.push_back(layer_a.name);
    }
    if (!picture.empty()) write_difference(picture, layer, b, layers_b, result, pictures);
    return result;
}

}  // namespace lightsieve
