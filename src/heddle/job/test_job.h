#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/geometry.h>
#include <heddle/io/file/test_files.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

// What tests of jobs share: a Progress that stops after some calls, and small inputs.

namespace heddle::test {

/// Is cancelled at the n-th call of advance(); 0: from the beginning. Keeps notes and parts.
class CancelAt final : public Progress {
public:
    explicit CancelAt(std::int64_t n) : left_(n) {
        if (n == 0) cancel();
    }
    void advance(std::int64_t) override {
        if (--left_ == 0) cancel();
    }
    void note(std::string_view sentence) override { notes.emplace_back(sentence); }
    void begin_part(std::string_view name) override { parts.emplace_back(name); }

    std::vector<std::string> notes, parts;

private:
    std::atomic<std::int64_t> left_;
};

constexpr std::int64_t kNever = std::int64_t{1} << 60;

/// Expects that `run` is cancelled from the beginning and at the first call of advance(), and
/// leaves nothing in the folder but `entries` files.
inline void expect_cancelled(const heddle::testing::TempFolder& folder,
                             std::size_t entries,
                             const std::function<void(Progress&)>& run) {
    for (const std::int64_t n : {0, 1}) {
        CancelAt progress(n);
        const std::optional<Error> error = heddle::testing::error_of([&] { run(progress); });
        ASSERT_TRUE(error.has_value()) << n << ": it went through";
        EXPECT_EQ(to_string(error->code()), "cancelled") << error->what();
        EXPECT_EQ(folder.count_entries(), entries) << n;
    }
}

/// Two yarns of the radius .2 along x, of one fiber material.
inline Geometry two_yarns() {
    Geometry geometry;
    geometry.name = "two";
    Material fiber;
    fiber.name = "fiber";
    fiber.kind = MaterialKind::Fiber;
    geometry.materials.push_back(fiber);
    CurveSet& set = geometry.curves.emplace_back();
    set.basis = Basis::Linear;
    set.points = {{0, 0, 0}, {1, 0, 0}, {2, 0.2f, 0}, {0, 1, 0}, {1, 1.2f, 0}, {2, 1, 0}};
    set.first = {0, 3, 6};
    set.default_radius = 0.2f;
    return geometry;
}

/// Two triangles of a surface.
inline Geometry square() {
    Geometry geometry;
    geometry.name = "square";
    geometry.materials.emplace_back();
    Mesh& mesh = geometry.meshes.emplace_back();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return geometry;
}

} // namespace heddle::test
