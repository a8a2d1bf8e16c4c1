#include <heddle/cli/material_edit.h>

#include <heddle/cli/terminal/option.h>

#include <gtest/gtest.h>

namespace heddle::cli {
namespace {

std::string refused(const std::string& text) {
    try {
        (void)material_edit_from(text);
    } catch (const UsageError& e) {
        return e.what();
    }
    return "no error";
}

TEST(MaterialEdit, ANameAKeyAndAValueAreTakenApart) {
    const job::MaterialEdit albedo = material_edit_from("cotton.albedo=0.8,0.2,0.1");
    EXPECT_EQ(albedo.material, "cotton");
    EXPECT_EQ(albedo.albedo, (Vec3f{0.8f, 0.2f, 0.1f}));
    EXPECT_FALSE(albedo.roughness.has_value());
    EXPECT_EQ(material_edit_from("1.name=a=b").name, "a=b");
    const job::MaterialEdit dotted = material_edit_from("a.b.alpha=0.5");
    EXPECT_EQ(dotted.material, "a.b");
    EXPECT_EQ(dotted.alpha, 0.5f);
    EXPECT_EQ(material_edit_from("linen.anisotropy_rotation=-1.5").anisotropy_rotation, -1.5f);
}

TEST(MaterialEdit, EveryKeyIsTaken) {
    for (const std::string& key : job::material_keys()) {
        EXPECT_NO_THROW((void)material_edit_from("a." + key + (key == "albedo" ? "=1,1,1" : "=1")));
    }
}

TEST(MaterialEdit, WrongOnesAreRefusedWithWhatWouldBeRight) {
    EXPECT_EQ(refused("cotton.albdo=1,1,1"), "--set: no key 'albdo'; did you mean 'albedo'?");
    EXPECT_NE(refused("cotton.kind=surface").find("no key 'kind'; the keys are: name, albedo"),
              std::string::npos);
    EXPECT_EQ(refused("cotton.albedo=1,1"),
              "--set cotton.albedo: '1,1' has 2 numbers; expected 3, separated by ','");
    EXPECT_EQ(refused("cotton.alpha=1.5"),
              "--set cotton.alpha: 1.5 is out of range; it must be 0 to 1");
    EXPECT_EQ(refused("cotton.alpha=nan"), "--set cotton.alpha: 'nan' is not a number");
    EXPECT_EQ(refused("cotton.name="), "--set cotton.name: the value is empty");
    EXPECT_EQ(refused("cotton"), "--set: 'cotton' is not NAME.KEY=VALUE");
    EXPECT_EQ(refused("cotton.alpha"), "--set: 'cotton.alpha' is not NAME.KEY=VALUE");
    EXPECT_EQ(refused("cotton.alhpa=1"), "--set: no key 'alhpa'; did you mean 'alpha'?");
}

} // namespace
} // namespace heddle::cli
