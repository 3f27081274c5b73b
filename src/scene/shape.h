// Shapes as plain geometry in object space, and the parameters that all shapes share.
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "scene/value.h"

namespace lightsieve {

/// Parameters of every shape node; `describe_shape_common` (nodes/shape/shape_common.h) documents them.
struct ShapeCommon {
    std::uint8_t visibility = 255;  ///< RayType bits that see the shape
    std::uint8_t sidedness =
        255;  ///< RayType bits for which both sides exist; others pass through back faces
    Array<NodeRef> shader;  ///< one, or one for each value of shidxs
    Array<Mat4f> matrix;    ///< world_from_object, one a motion key
    float motion_start = 0, motion_end = 1;
    bool receive_shadows = true, self_shadows = true, matte = false, invert_normals = false;
    bool opaque = true;  ///< deprecated, without effect
    float ray_bias = 1e-6F;
    /// Above 0 the shape is no surface but the container of a volume.
    float step_size = 0;
    float volume_padding = 0;  ///< how much a container reaches beyond the shape
    std::uint32_t id = 0;
    bool use_light_group = false, use_shadow_group = false;
    Array<NodeRef> light_group, shadow_group;
    Array<Name> trace_sets;
    Array<NodeRef> disp_map;
};

/// Triangles made of polygons. All index arrays have three entries a triangle.
struct TriangleMesh {
    std::vector<std::vector<Vec3f>> positions;  ///< one list a motion key
    std::vector<std::uint32_t> indices;
    std::vector<std::vector<Vec3f>>
        normals;  ///< one list a motion key; empty: shade with the face normal
    std::vector<std::uint32_t> normal_indices;
    std::vector<Vec2f> uvs;  ///< empty: no uv
    std::vector<std::uint32_t> uv_indices;
    std::vector<std::uint32_t> face;  ///< polygon of each triangle
    std::vector<std::uint32_t>
        corner;  ///< face corner (position in vidxs) of each triangle corner
    std::vector<std::uint8_t> shader_index;  ///< into `shader`, one a triangle; empty: all 0
};

/// Spheres, exact.
struct SphereList {
    std::vector<std::vector<Vec3f>> centers;  ///< one list a motion key
    std::vector<float> radii;
};

/// Hair, grass, thread: segments of curves with a radius. Cubic ones are Bezier segments, whatever basis the node was given
/// in, so that rays and shading know one kind only.
struct CurveList {
    enum class Mode : std::uint8_t {
        Ribbon,  ///< flat, always turned to the viewer; shaded as the round fibre that it stands for
        Thick,    ///< round
        Oriented  ///< flat, across the given normals
    };
    /// Of one segment.
    struct Segment {
        std::uint32_t first = 0;  ///< control point; a cubic segment has 4, a linear one 2
        std::uint32_t curve = 0;  ///< number of the curve in the node
        float v0 = 0, v1 = 1;     ///< how far along its curve the segment begins and ends, [0,1]
    };
    Mode mode = Mode::Ribbon;
    bool linear = false;                      ///< segments are straight: two control points each
    std::vector<std::vector<Vec3f>> points;   ///< control points, one list a motion key
    std::vector<std::vector<float>> radii;    ///< of the control points; as many keys as points
    std::vector<std::vector<Vec3f>> normals;  ///< of the control points; Oriented only
    std::vector<Segment> segments;
    std::vector<Vec2f> uvs;  ///< by curve; empty: shaders see across and along as uv

    [[nodiscard]] std::uint32_t n_controls() const { return linear ? 2 : 4; }
};

class VolumeGrids;  // io/volume_grid.h

struct ShapeGeometry {
    std::variant<TriangleMesh, SphereList, CurveList> data;
    /// The geometry is the boundary of a volume. A box's mesh is one; it is known to be a box.
    bool is_volume = false;
    Box3f volume_box;                          ///< object space; empty: the geometry is no box
    std::shared_ptr<const VolumeGrids> grids;  ///< channels of the volume; null: none
    /// A ginstance gives no geometry of its own but another node's.
    NodeRef instance_of;
    bool inherit_xform = true;
};

}  // namespace lightsieve
