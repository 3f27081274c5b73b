// procedural: what another file holds. Files are read when the scene is assembled (scene/assemble.h).
#include "nodes/shape/shape_common.h"
#include "scene/node_context.h"

namespace lightsieve {
namespace {

struct Procedural : ShapeNode {
    Name filename, dso, name_space;
    bool auto_instancing = true, override_nodes = false, load_at_init = true;
    NodeRef op;
    Vec3f min, max;

    static NodeType describe() {
        Describe<Procedural> d("procedural", NodeKind::Shape,
                               "What an .ass file holds: shapes and lights, moved by the matrix. "
                               "Names inside are looked "
                               "for there first, then outside.");
        describe_shape_common(d);
        d.param("filename", &Procedural::filename, "The .ass or .ass.gz file.");
        d.param("dso", &Procedural::dso, "Older name of filename.");
        d.param("namespace", &Procedural::name_space,
                "What names inside begin with, before a ^; none: the procedural's own name.");
        d.param("auto_instancing", &Procedural::auto_instancing,
                "Procedurals of the same file share what it holds.");
        d.param(
            "override_nodes", &Procedural::override_nodes,
            "Every value that is written here overrides those inside. Off: a shader does, and "
            "values other than their defaults; visibility and sidedness are restricted further.");
        d.param("operator", &Procedural::op,
                "Last node of a chain that edits what the file holds.");
        d.param("load_at_init", &Procedural::load_at_init, "Older switch of when files are read.")
            .ignored();
        d.param("min", &Procedural::min, "Older bounds, to read files later.").ignored();
        d.param("max", &Procedural::max, "Older bounds, to read files later.").ignored();
        return d.done();
    }

    /// It has shapes, but is none.
    [[nodiscard]] std::unique_ptr<ShapeGeometry> make_geometry(NodeContext&) const {
        return nullptr;
    }
};

}  // namespace

NodeType node_procedural() { return Procedural::describe(); }

}  // namespace lightsieve
