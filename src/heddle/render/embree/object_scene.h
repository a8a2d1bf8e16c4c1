#pragma once

#include <heddle/render/embree/device.h>
#include <heddle/render/embree/embree_scene.h>
#include <heddle/render/embree/mesh_surface.h>
#include <heddle/render/embree/round_curves.h>
#include <heddle/render/embree/yarn_curves.h>

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace heddle {

/// A hit on an object, in object space.
struct ObjectPoint {
    std::uint32_t geometry = 0;  ///< Embree's geometry id
    std::uint32_t primitive = 0; ///< Embree's
    float u = 0.0f, v = 0.0f;
};

/// The properties of an object at a point, in object space.
struct ObjectSample {
    bool curve = false;
    std::uint32_t material = 0; ///< index among the geometry's
    MeshSample surface;         ///< for a curve: only the albedo, and its direction as `tangent`
};

/// One geometry in its own Embree scene, to which instances refer. Must not be moved in memory.
class ObjectScene {
public:
    /// @throws Error  as build_embree_scene
    ObjectScene(EmbreeDevice& device,
                std::shared_ptr<const Geometry> geometry,
                const EmbreeOptions& options,
                Progress& progress);
    ObjectScene(const ObjectScene&) = delete;
    ObjectScene& operator=(const ObjectScene&) = delete;

    [[nodiscard]] const Geometry& geometry() const { return *geometry_; }
    [[nodiscard]] RTCScene scene() const { return scene_.get(); }
    [[nodiscard]] ObjectSample sample(const ObjectPoint& at) const;

private:
    /// One Embree geometry: a mesh or curves.
    struct Part {
        const ObjectScene* object = nullptr;
        std::uint32_t mesh = 0;
        bool curve = false;
        RoundCurves curves;
    };

    void add_curves(Progress& progress);
    void add_yarns(const FiberSource& source, YarnSet yarns, Progress& progress);
    void attach_curves(RoundCurves curves);
    void attach_mesh(std::uint32_t mesh);
    [[nodiscard]] static bool covers(const Part& part, const ObjectPoint& at);
    static void filter_back(const RTCFilterFunctionNArguments* arguments);
    static void filter_alpha(const RTCFilterFunctionNArguments* arguments);

    EmbreeDevice& device_;
    std::shared_ptr<const Geometry> geometry_;
    EmbreeOptions options_;
    MeshSurfaces surfaces_;
    std::deque<Part> parts_; ///< by Embree's geometry id; Embree holds pointers to them
    EmbreeScene scene_;      ///< last: it reads the buffers above until it is released
};

} // namespace heddle
