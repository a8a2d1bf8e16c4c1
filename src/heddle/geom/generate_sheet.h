#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/generate.h>

namespace heddle::generate_parts {

/// A wave that a strip of length takes without stretching: its slope angle is
/// amplitude x sin(2 pi s / wavelength), the sine-generated curve of river bends.
/// [Langbein, Leopold 1966, "River meanders - theory of minimum variance"]
struct Meander {
    double wavelength = 1.0; ///< along the strip, scene units, > 0
    double amplitude = 0.0;  ///< radians, in [0, 1.2]

    struct Point {
        double along = 0.0;
        double across = 0.0;
        double slope = 0.0; ///< radians
    };
    /// Where the strip's point at length `s` lies.
    [[nodiscard]] Point at(double s) const;
};

/// Carries a flat cloth onto its shape: an isometry of the middle surface, or close to one.
class Sheet {
public:
    /// @param width, height  of the flat cloth along x and y, scene units, > 0
    /// @param thickness      of the cloth, scene units, > 0
    /// @throws InvalidArgument: too short along y to be folded
    Sheet(GenerateShape shape, double width, double height, double thickness);

    /// @param p  on the flat cloth: x and y along it, z the height above its middle
    [[nodiscard]] Vec3d place(Vec3d p) const;

    [[nodiscard]] int layers() const { return layers_; }

private:
    [[nodiscard]] Vec3d fold(Vec3d p) const;
    [[nodiscard]] Vec3d hang(Vec3d p) const;

    GenerateShape shape_;
    double width_;
    double height_;
    double fold_radius_;      ///< of the middle surface in a fold
    double panel_ = 0.0;      ///< flat length between two folds
    int layers_ = 1;          ///< of the folded stack
    double wavelength_ = 1.0; ///< of a hanging cloth's folds
    double slope_ = 0.0;      ///< of a hanging cloth at its hem, radians
};

} // namespace heddle::generate_parts
