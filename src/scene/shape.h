// Shapes as plain geometry in object space, and the parameters that all shapes share.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "scene/value.h"

namespace lightsieve {

/// How matrices between motion keys are found.
enum class TransformType : std::int32_t {
    Linear,             ///< element by element
    RotateAboutOrigin,  ///< turned about the origin of object space, which moves straight
    RotateAboutCenter   ///< turned about the middle of the shape's bounds, which moves straight
};

/// Parameters of every shape node; `describe_shape_common` (nodes/shape/shape_common.h) documents them.
struct ShapeCommon {
    std::uint8_t visibility = 255;  ///< RayType bits that see the shape
    std::uint8_t sidedness =
        255;  ///< RayType bits for which both sides exist; others pass through back faces
    Array<NodeRef> shader;  ///< one, or one for each value of shidxs
    Array<Mat4f> matrix;    ///< world_from_object, one a motion key
    TransformType transform_type = TransformType::RotateAboutCenter;
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

/// Where the quads of a subdivided mesh lie in the faces that it was made of: user data are given there.
///
/// A face of four corners holds a grid of quads; every other face of n corners is parted into n quarters, one a corner,
/// which hold a grid each. Quads keep their orientation: corner k of a quad lies toward corner k of the grid.
struct MeshOrigin {
    // The faces. Polygons with holes were split into triangles first.
    std::vector<std::uint32_t> first_corner;  ///< of each face in the next two, and the end
    std::vector<std::uint32_t> corner;        ///< face corner: position in vidxs
    std::vector<std::uint32_t> vertex;        ///< its vertex
    // The quads, two triangles each: of corners 0 1 2 and 0 2 3.
    std::vector<std::uint32_t> face;     ///< of each quad
    std::vector<std::uint32_t> quarter;  ///< of each quad; 0 in faces of four corners
    std::vector<Vec2f>
        place;  ///< of each quad: its corner 0 in the grid, whose corners are at 0 0, 1 0, 1 1, 0 1
    /// Length of a quad's edge in the grid: of faces with four corners, and of others.
    float size_in_quads = 1, size_in_others = 1;
};

/// What a displacement does to a mesh beside disp_map, which is a shader.
struct Displacement {
    float height = 1, zero_value = 0;
    bool autobump = false;
    std::uint8_t autobump_visibility = 1;  ///< RayType bits that see the finer part as bumps
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
    /// Of a subdivided mesh, whose `corner` is empty and whose triangles come in pairs, one a quad; null: of others.
    std::shared_ptr<const MeshOrigin> origin;
    std::optional<Displacement> displacement;  ///< disp_map is to move the vertices
};

/// Spheres, exact. Lights have no other.
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
    bool linear = false;                     ///< segments are straight: two control points each
    std::vector<std::vector<Vec3f>> points;  ///< control points, one list a motion key
    std::vector<std::vector<float>> radii;   ///< of the control points; as many keys as points
    /// What the radii were before thin curves were widened (min_pixel_width), to be made transparent; empty: none was.
    std::vector<std::vector<float>> own_radii;
    std::vector<std::vector<Vec3f>> normals;  ///< of the control points; Oriented only
    std::vector<Segment> segments;
    std::vector<Vec2f> uvs;  ///< by curve; empty: shaders see across and along as uv

    [[nodiscard]] std::uint32_t n_controls() const { return linear ? 2 : 4; }
};

/// Particles. Disks and quads are flat and always turned to where the ray comes from.
struct PointList {
    enum class Mode : std::uint8_t { Disk, Sphere, Quad };
    Mode mode = Mode::Disk;
    std::vector<std::vector<Vec3f>> centers;  ///< one list a motion key
    std::vector<std::vector<float>> radii;  ///< as many keys as centers; of quads half their width
    /// What the radii were before small points were widened (min_pixel_width), to be made transparent; empty: none was.
    std::vector<std::vector<float>> own_radii;
    std::vector<float> aspect;         ///< width by height; quads only
    std::vector<float> rotation_rad;   ///< counter-clockwise as seen, away from `up`; quads only
    std::vector<std::uint32_t> index;  ///< number of each point in the node
    Vec3f up{0, 1, 0};                 ///< upward edges of quads lean to it; object space
};

/// One exact part of a cone, a disk or a plane; scene/simple_shape.h has its geometry.
struct SimpleShape {
    enum class Kind : std::uint8_t {
        Mantle,  ///< side of a cone or cylinder from `base` to `base + axis * height`; open ends
        Disk,    ///< around `base`, facing `axis`
        Plane    ///< through `base`, facing `axis`, without end
    };
    Kind kind = Kind::Mantle;
    Vec3f base;
    Vec3f axis{0, 1, 0};  ///< unit
    float height = 1;     ///< Mantle
    /// Mantle: at the base and at the top; Disk: of the rim and of the hole.
    float radius = 0.5F, second_radius = 0.5F;
};

/// What an instancer places: a value an instance in each array. An array of one value, or a last value, stands for all
/// further instances; an empty one says nothing.
struct InstanceList {
    Array<NodeRef> nodes;            ///< what is placed
    Array<std::uint32_t> node_idxs;  ///< which of them; empty: the first
    Array<Mat4f> instance_matrix;    ///< world_from_object; motion keys as in any array
    Array<float> instance_motion_start, instance_motion_end;  ///< times of the keys
    // What an instance has instead of what the placed shape has.
    Array<std::uint8_t> instance_visibility, instance_sidedness;
    Array<NodeRef> instance_shader;
    Array<bool> instance_inherit_xform;  ///< the placed shape's own matrix comes first
    Array<bool> instance_matte, instance_invert_normals, instance_receive_shadows,
        instance_self_shadows, instance_use_light_group, instance_use_shadow_group;
    Array<std::uint32_t> instance_id;
    Array<NodeRef> instance_light_group, instance_shadow_group;  ///< one list for all instances

    /// How many instances there are.
    [[nodiscard]] std::uint32_t size() const {
        return instance_matrix.n > 1 ? instance_matrix.n
                                     : std::max(instance_matrix.n, node_idxs.n);
    }
    /// The value of instance `i`; `fallback` where the array says nothing.
    template <class T>
    [[nodiscard]] static T value(const Array<T>& array, std::uint32_t i, T fallback) {
        return array.empty() ? fallback : array.data[std::min(i, array.n - 1)];
    }
};

class VolumeGrids;  // io/volume_grid.h

struct ShapeGeometry {
    std::variant<TriangleMesh, SphereList, CurveList, PointList, SimpleShape> data;
    /// The geometry is the boundary of a volume. A box's mesh is one; it is known to be a box.
    bool is_volume = false;
    Box3f volume_box;                          ///< object space; empty: the geometry is no box
    std::shared_ptr<const VolumeGrids> grids;  ///< channels of the volume; null: none
    /// A ginstance gives no geometry of its own but another node's.
    NodeRef instance_of;
    bool inherit_xform = true;
    /// An instancer gives none either: it lists what it places. Points into its node's block.
    const InstanceList* instances = nullptr;
};

}  // namespace lightsieve
