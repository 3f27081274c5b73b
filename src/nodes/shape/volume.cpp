// volume: a box filled with what its shader says, with the grids of an OpenVDB file as channels.
#include <string>
#include <vector>

#include "core/error.h"
#include "io/volume_grid.h"
#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct Volume : ShapeNode {
    Name filename;
    Array<Name> grids, velocity_grids;
    float velocity_scale = 1, velocity_fps = 24, velocity_outlier_threshold = 0.001F;
    float velocity_shutter_start = 0, velocity_shutter_end = 0, frame = 0, step_scale = 1;
    bool compress = true;
    Vec3f min{0, 0, 0}, max{0, 0, 0};

    static NodeType describe() {
        Describe<Volume> d("volume", NodeKind::Shape,
                           "A volume: the grids of an OpenVDB file, or a box.");
        describe_shape_common(d);
        d.param("filename", &Volume::filename, "OpenVDB file; empty: the box from min to max.");
        d.param("grids", &Volume::grids,
                "Grids that shaders may ask for; empty: all that the file has.");
        d.param("min", &Volume::min, "Lower corner of the box, where there is no file.")
            .unit("scene units");
        d.param("max", &Volume::max, "Upper corner of the box.").unit("scene units");
        d.param("step_scale", &Volume::step_scale, "Arnold's length of steps in voxels.")
            .ignored();
        d.param("compress", &Volume::compress, "How Arnold stores grids.").ignored();
        d.param("velocity_grids", &Volume::velocity_grids, "Grids for motion blur.").pending();
        const char* with_grids = "Acts with velocity_grids.";
        d.param("velocity_scale", &Volume::velocity_scale, with_grids).ignored();
        d.param("velocity_fps", &Volume::velocity_fps, with_grids).ignored();
        d.param("velocity_outlier_threshold", &Volume::velocity_outlier_threshold, with_grids)
            .ignored();
        d.param("velocity_shutter_start", &Volume::velocity_shutter_start, with_grids).ignored();
        d.param("velocity_shutter_end", &Volume::velocity_shutter_end, with_grids).ignored();
        d.param("frame", &Volume::frame, with_grids).ignored();
        return d.done();
    }

    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext& context) const {
        auto out = std::make_unique<ShapeGeometry>();
        out->is_volume = true;
        Box3f box{min, max};
        if (!filename.empty()) {
            out->grids = load(context);
            if (!out->grids) return nullptr;
            box = out->grids->bounds();
        }
        const Vec3f padding = Vec3f{1, 1, 1} * std::max(volume_padding, 0.0F);
        box.lower = box.lower - padding;
        box.upper = box.upper + padding;
        const Vec3f size = box.size();
        if (!is_finite(size) || !(size.x > 0) || !(size.y > 0) || !(size.z > 0)) {
            context.diagnostics().warning(
                Code::ShapeBad, "the volume is empty",
                context.where(filename.empty() ? "max" : "filename"),
                filename.empty() ? "give it a file, or min and max" : "");
            return nullptr;
        }
        out->volume_box = box;
        out->data = box_mesh(box);
        return out;
    }

  private:
    /// The grids; null with a problem reported. A volume that cannot be read leaves the rest of the scene as it is.
    [[nodiscard]] std::shared_ptr<const VolumeGrids> load(NodeContext& context) const {
        const std::optional<std::string> path = context.find_asset(filename.view());
        std::vector<std::string> names;
        for (const Name name : grids.first_key())
            names.push_back(name.str());
        try {
            return load_volume(path.value_or(filename.str()), names);
        } catch (const InputError& e) {
            for (Error error : e.errors()) {
                if (!error.where.known()) error.where = context.where("filename");
                error.severity = Severity::Warning;
                error.message += "; the volume is left out";
                context.diagnostics().add(error);
            }
            return nullptr;
        }
    }
};

}  // namespace

NodeType node_volume() { return Volume::describe(); }

}  // namespace lightsieve
