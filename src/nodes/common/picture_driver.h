// What driver_png, driver_tiff and driver_jpeg share: one layer, converted to the picture's colour space, written at the end.
//
// The frame is held in memory: these formats store rows from the top, and pictures are small beside EXR files.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/color.h"
#include "io/image_write.h"
#include "scene/driver.h"
#include "scene/node_context.h"

namespace lightsieve {

/// What the nodes ask for.
struct PictureOptions {
    PictureFormat format = PictureFormat::Png;
    PictureType type = PictureType::UInt8;
    TiffCompression compression = TiffCompression::Lzw;
    bool tiled = false, dither = true;
    bool unpremult_alpha =
        false;  ///< divide colours by alpha; acts on 8-bit pictures only, as in Arnold
    bool skip_alpha = false;
    bool append = false;         ///< goes on with a file that is there: what is not rendered stays
    int quality = 100;           ///< of JPEG
    bool output_padded = false;  ///< the whole frame, black around the region that was rendered
};

class PictureDriver final : public Driver {
  public:
    /// filename, color_space  parameters of the node, which `context` knows the places of
    PictureDriver(Name filename, Name color_space, const PictureOptions& options,
                  NodeContext& context);

    [[nodiscard]] std::string path() const override { return path_; }
    [[nodiscard]] OutputForecast forecast(const ImageHeader& header) const override;
    [[nodiscard]] bool open(const ImageHeader& header, Diagnostics& diagnostics) override;
    void write(const Bucket& bucket) override;
    [[nodiscard]] bool close(Diagnostics& diagnostics) override;

  private:
    [[nodiscard]] bool fits(const ImageHeader& header, Diagnostics& diagnostics) const;
    /// Takes over the pixels of the file that is there, if it is such a picture.
    void take_over(Diagnostics& diagnostics);
    /// One pixel of the layer as it is to be stored.
    void store(const float* pixel, float* out) const;

    std::string path_;
    SourceSpan where_;
    PictureOptions options_;
    ColorConversion conversion_;
    ImageLayer layer_;
    PictureSpec spec_;
    int left_ = 0, top_ = 0;     ///< frame pixel at the picture's corner
    std::vector<float> pixels_;  ///< the picture
};

}  // namespace lightsieve
