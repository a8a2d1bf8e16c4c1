#pragma once

#include <heddle/base/progress.h>
#include <heddle/geom/geometry.h>
#include <heddle/io/file/test_files.h>

#include <atomic>
#include <functional>
#include <string>
#include <vector>

// Shared by the tests of jobs: a Progress that cancels after some calls, and small inputs.

namespace heddle::test {

/// Cancels at the n-th call of advance(); 0: from the beginning. Records notes and parts.
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

/// Cancels `run` at its beginning, then at its first call of advance(). Expects both times that it
/// is cancelled and that the folder has `entries` files.
inline void expect_cancelled(const heddle::testing::TempFolder& folder,
                             std::size_t entries,
                             const std::function<void(Progress&)>& run) {
    for (const std::int64_t n : {0, 1}) {
        CancelAt progress(n);
        const std::optional<Error> error = heddle::testing::error_of([&] { run(progress); });
        ASSERT_TRUE(error.has_value()) << n << ": the run was not cancelled";
        EXPECT_EQ(to_string(error->code()), "cancelled") << error->what();
        EXPECT_EQ(folder.count_entries(), entries) << n;
    }
}

/// Returns two yarns of radius 0.2 along x, of one fiber material.
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

/// Returns a unit square of two triangles.
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
