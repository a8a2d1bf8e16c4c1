#include <heddle/sggx/eigen.h>

#include <heddle/sggx/test_lobe.h>

#include <gtest/gtest.h>

namespace heddle {
namespace {

void expect_decomposed(const SymmetricMatrix& A, double tolerance) {
    const SymmetricEigen e = decompose(A);
    EXPECT_GE(e.value[0], e.value[1] - tolerance);
    EXPECT_GE(e.value[1], e.value[2] - tolerance);
    for (int i = 0; i < 3; ++i) {
        const detail::SymmetricMatrixd M{A.xx, A.yy, A.zz, A.xy, A.xz, A.yz};
        EXPECT_LT(length(detail::multiply(M, e.axis[i]) - e.axis[i] * e.value[i]), tolerance);
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(dot(e.axis[i], e.axis[j]), i == j ? 1.0 : 0.0, 1e-9);
    }
    EXPECT_NEAR(dot(cross(e.axis[0], e.axis[1]), e.axis[2]), 1.0, 1e-9);
}

TEST(Eigen, RandomMatricesGiveTheirOwnVectors) {
    CounterRandom random{1, 1};
    for (int i = 0; i < 20000; ++i) {
        const Vec3d value{random.uniform(), random.uniform(), random.uniform()};
        expect_decomposed(test::rotate(value, random), 1e-9);
    }
}

TEST(Eigen, RepeatedAndZeroEigenvaluesAreNoSpecialCase) {
    CounterRandom random{1, 2};
    for (const Vec3d value :
         {Vec3d{1, 0, 0}, Vec3d{1, 1, 0}, Vec3d{1, 1, 1}, Vec3d{1, 1e-7, 0}, Vec3d{1, 1, 1 - 1e-7},
          Vec3d{0, 0, 0}, Vec3d{1e-30, 1e-31, 0}, Vec3d{1e15, 1e14, 1e13}, Vec3d{1, -1, 0}}) {
        const double scale = std::max(std::fabs(value.x), 1e-300);
        expect_decomposed({static_cast<float>(value.x), static_cast<float>(value.y),
                           static_cast<float>(value.z), 0, 0, 0},
                          1e-9 * scale);
        for (int i = 0; i < 100; ++i) expect_decomposed(test::rotate(value, random), 1e-9 * scale);
    }
}

TEST(Eigen, PrincipalDirectionIsTheAxisOfANeedleWithAFixedSign) {
    CounterRandom random{1, 3};
    for (int i = 0; i < 1000; ++i) {
        const Vec3d d = test::random_direction(random);
        const Vec3f p = principal_direction(test::pool({d}));
        EXPECT_NEAR(std::fabs(dot(to_double(p), d)), 1.0, 1e-6);
        const Vec3f size{std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)};
        const int lead = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        EXPECT_GT(p[lead], 0.0f);
    }
    EXPECT_EQ(principal_direction({1, 1, 1, 0, 0, 0}), (Vec3f{1, 0, 0}));
}

} // namespace
} // namespace heddle
