// Shader networks, ready to run: parameter blocks with their links resolved, and the lobes' records.
//
// Evaluating a shader copies its block to the thread's arena, writes the results of linked shaders into the copy, and
// calls the node's function: node code never asks whether a parameter is connected. A shader without links runs on its own
// block. No string work; memory comes from the heap only until the arena has grown to the deepest network.
#pragma once

#include <compare>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bsdf/closure.h"
#include "scene/node_type.h"
#include "scene/shade_point.h"

namespace lightsieve {

/// Labels that a scene gives to the events of a shader. Each use of a shader with other labels has a program of its own.
struct EventLabels {
    std::string
        closure;  ///< from the `label` of a closure or of a node that wraps it; empty: the lobes' own
    std::string object;  ///< `lpe_label` of the shape; empty: none
    friend auto operator<=>(const EventLabels&, const EventLabels&) = default;
};

class ShaderProgram {
  public:
    /// One linked parameter (or element or component of one).
    struct Patch {
        std::size_t offset = 0;  ///< of the parameter in the block; within its elements for arrays
        ParamType type{};        ///< of the parameter
        int component = -1;      ///< 0..3, or -1: the whole value
        const ShaderProgram* source = nullptr;
        int source_component = -1;  ///< 0..3, or -1: the whole value
        int array = -1;             ///< of an array: which one of the program's linked arrays
    };
    /// Links into one Lazy parameter; offsets count from its value.
    using LazyPatches = std::vector<Patch>;

    ShaderProgram(const NodeType& type, const std::byte* block);

    /// Adds a link. The source must be complete before the first evaluation. For `element` >= 0 the parameter is an array.
    void add_link(const ParamInfo& param, std::int32_t element, Patch patch);
    /// Finds a linked value and writes it to the parameter, or element, at `at`.
    static void apply(const Patch& patch, std::byte* at, const ShadePoint& point);
    /// Takes over all links of another program of the same node.
    void share_links(const ShaderProgram& other);
    /// Whether anything drives a parameter.
    [[nodiscard]] bool is_linked() const { return !patches_.empty() || !lazy_.empty(); }
    /// Whether it may look at uv, their derivatives or the tangent: what is linked to it may always.
    [[nodiscard]] bool reads_coordinates() const;
    [[nodiscard]] const NodeType& type() const { return *type_; }
    [[nodiscard]] std::byte* block() { return block_.get(); }
    [[nodiscard]] const std::byte* block() const { return block_.get(); }

    /// Result of a value shader; of others black.
    [[nodiscard]] ShaderValue value(const ShadePoint& at) const;
    /// Result of a shader that gives text; of others empty.
    [[nodiscard]] Name text(const ShadePoint& at) const;
    /// Result of a shader that gives a matrix; of others the identity.
    [[nodiscard]] Mat4f matrix(const ShadePoint& at) const;
    /// Adds the shader's closures. A value shader is shown unlit: its colour is emission through lobe 0.
    void closures(const ShadePoint& at, ClosureSet& out) const;

    /// Of the node; empty for the default shader.
    Name name;
    /// Lobes with their events; filled when the scene's expressions are compiled.
    std::vector<LobeRecord> records;
    /// Labels that its events carry in place of, or beside, those of its lobes.
    EventLabels labels;
    /// Shaders whose closures it takes over (mix_shader.shader1).
    std::vector<const ShaderProgram*> parts;
    /// Of the body that it covers, if it is one.
    int dielectric_priority = 0;
    /// Whether rays may pass straight through what this shader covers.
    bool may_be_transparent = false;
    /// Whether shadow rays may pass where others are refracted (ClosureSet::transmit_shadow).
    bool may_tint_shadows = false;
    /// Whether the body that it covers may scatter light inside.
    bool may_scatter_inside = false;

  private:
    struct FreeBlock {
        void operator()(std::byte* p) const { ::operator delete[](p, std::align_val_t{16}); }
    };
    /// An array of which elements are linked: copied with the block.
    struct LinkedArray {
        std::size_t offset = 0;   ///< of the parameter in the block
        std::size_t n_bytes = 0;  ///< of all elements
        std::size_t place = 0;    ///< of the elements' copy behind the block's
    };
    /// Calls `body` with the block, linked values written into a copy of it where there are any.
    template <class Body>
    auto with_block(const ShadePoint& at, const Body& body) const;
    void patch(std::byte* copy, const ShadePoint& at) const;

    const NodeType* type_;
    std::unique_ptr<std::byte[], FreeBlock> block_;
    std::size_t scratch_size_;  ///< of a copy: the block and linked arrays
    std::vector<Patch> patches_;
    std::vector<LinkedArray> arrays_;
    /// Links into Lazy parameters, whose blocks point here; programs of one node share them.
    std::vector<std::shared_ptr<LazyPatches>> lazy_;
};

/// A colour parameter of a node that is no shader, with what is linked to it or its channels.
struct LinkedColor {
    Color written;
    std::vector<ShaderProgram::Patch> links;
};

}  // namespace lightsieve
