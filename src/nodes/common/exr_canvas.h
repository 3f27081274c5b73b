// Pixels of an EXR file, kept until all have come: only then it is known how large the file's data window is (autocrop).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/exr_write.h"

namespace lightsieve {

class ExrCanvas {
  public:
    /// spec  as for an ExrWriter, with the largest data window that the file may have
    explicit ExrCanvas(ExrWriteSpec spec);
    /// Adds a rectangle, as ExrWriter::write does.
    void write(int x, int y, int width, int height, std::span<const ExrPlane> planes);
    /// Cuts the data window to what is not 0, at least one pixel, and writes the file.
    /// throws  InputError as ExrWriter
    void save(const std::string& path);

  private:
    /// In pixels of the canvas; x1, y1 are outside.
    struct Box {
        int x0, y0, x1, y1;
    };
    [[nodiscard]] Box filled() const;
    [[nodiscard]] bool is_empty(int x, int y) const;

    ExrWriteSpec spec_;
    std::vector<std::vector<float>> channels_;
};

}  // namespace lightsieve
