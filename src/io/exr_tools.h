// What `lightsieve exr info`, `exr verify` and `exr diff` do; they return plain data, the command line prints.
//
// Works on any OpenEXR file; what Arnold and Lightsieve write into the header (`arnold/aovs/<layer>/...`) is used
// where it is there. `verify` re-checks from the pixels the sums that the renderer proved, light groups among them;
// the attribute `lightsieve/partitions` holds one a line: "RGBA = diffuse + specular + ...".
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/exr_read.h"

namespace lightsieve {

/// One layer of a file.
struct ExrLayer {
    std::string name;  ///< "RGBA" for bare R, G, B (or what the header calls them)
    std::vector<std::size_t> channels;  ///< indices into ExrFile::channels: R G B A, X Y Z or one
    std::vector<std::string> suffixes;  ///< "R", "G", ...; "" for a channel that is the layer
    ExrPixelType type = ExrPixelType::Float;  ///< of the first channel
    std::string source;       ///< the AOV, before renaming; empty if the header does not say
    std::string filter;       ///< empty if the header does not say
    float filter_width = 0;   ///< [pixels]
    std::string expression;   ///< light path expression; empty if none
    std::string light_group;  ///< empty if none
    std::string camera;       ///< of several; empty if the header does not say
};

/// The layers of a file, the unnamed one first, then by name.
[[nodiscard]] std::vector<ExrLayer> exr_layers(const ExrFile& file);

/// A file's header and layers.
struct ExrInfo {
    ExrFile file;  ///< without pixels
    std::vector<ExrLayer> layers;
};
/// throws  InputError as read_exr_header
[[nodiscard]] ExrInfo exr_info(const std::string& path);

/// One sum that was checked.
struct ExrSumCheck {
    std::string text;      ///< "RGBA = diffuse + specular"
    bool checked = false;  ///< false: could not be checked, see `reason`
    bool passed = false;
    std::string reason;  ///< why it could not be checked
    int worst_x = 0,
        worst_y = 0;  ///< frame pixel with the largest residual in relation to its tolerance
    std::string worst_channel;  ///< "R", "G", "B"
    double whole = 0, sum = 0;  ///< there
    double residual = 0;        ///< |whole - sum| there
    double tolerance = 0;       ///< allowed there
    std::size_t n_failed = 0;   ///< pixels above their tolerance
};
struct ExrVerifyResult {
    std::vector<ExrSumCheck> checks;
    /// True if something was checked and everything that was checked passed.
    [[nodiscard]] bool passed() const;
};
/// Allowed residual, as a part of the sum of the layers' magnitudes.
inline constexpr double kFloatSumTolerance = 1e-5;
inline constexpr double kHalfSumTolerance = 0x1p-10;
/// throws  InputError as read_exr
[[nodiscard]] ExrVerifyResult exr_verify(const std::string& path);

/// How one layer of two files differs.
struct ExrLayerDiff {
    std::string name;
    std::size_t n_values = 0;     ///< compared: pixels times channels
    std::size_t n_different = 0;  ///< not the same bits' value
    std::size_t n_nonfinite =
        0;                    ///< NaN or infinite in either file, left out of the figures below
    double rmse = 0;          ///< root of the mean squared difference
    double relative_mse = 0;  ///< mean of (a-b)^2 / (b^2 + kRelativeMseEpsilon)
    double max_difference = 0;
    int max_x = 0, max_y = 0;  ///< frame pixel of the largest difference
};
struct ExrDiffResult {
    std::vector<ExrLayerDiff> layers;  ///< those that both files have
    std::vector<std::string> only_a, only_b;
};
/// Keeps black pixels from dividing by 0; small against values that are seen.
inline constexpr double kRelativeMseEpsilon = 1e-2;
/// Compares a with the reference b over b's data window.
///
/// picture  if not empty: |a - b| of every common layer goes to this .exr, of `layer` (or the first) to this .png or .tif
/// throws   InputError as read_exr; pictures of different sizes (picture-size); unknown layer (unknown-layer)
[[nodiscard]] ExrDiffResult exr_diff(const std::string& a, const std::string& b,
                                     const std::string& picture = {},
                                     const std::string& layer = {});

}  // namespace lightsieve
