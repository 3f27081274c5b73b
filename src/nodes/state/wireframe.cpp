// wireframe: the edges of a mesh.
#include "nodes/state/wires.h"
#include "scene/describe.h"

namespace lightsieve {
namespace {

enum class EdgeType : std::int32_t { Triangles, Polygons, Patches };

struct Wireframe {
    float line_width = 1;
    Color fill_color{1, 1, 1}, line_color{0, 0, 0};
    bool raster_space = true;
    EdgeType edge_type = EdgeType::Triangles;

    static NodeType describe() {
        Describe<Wireframe> d("wireframe", NodeKind::Shader, "The edges of a mesh.");
        d.param("line_width", &Wireframe::line_width,
                "Width of the lines: pixels with raster_space, else scene units.");
        d.param("fill_color", &Wireframe::fill_color, "Colour between the lines.");
        d.param("line_color", &Wireframe::line_color, "Colour of the lines.");
        d.param("raster_space", &Wireframe::raster_space, "line_width counts pixels.");
        d.param("edge_type", &Wireframe::edge_type, "Edges of triangles or of polygons.")
            .names({"triangles", "polygons", "patches"});
        return d.done();
    }
    [[nodiscard]] Color eval(const ShadePoint& at) const {
        const float width = raster_space ? line_width * at.width : line_width;
        return lerp(fill_color, line_color,
                    line_cover(at, width, edge_type != EdgeType::Triangles));
    }
};

}  // namespace

NodeType node_wireframe() { return Wireframe::describe(); }

}  // namespace lightsieve
