#pragma once

#include <heddle/base/vec.h>
#include <heddle/geom/generate.h>

namespace heddle::generate_parts {

/// A wave that a strip follows without stretching: its slope angle is amplitude x sin(2 pi s /
/// wavelength), the sine-generated curve of river bends.
/// [Langbein, Leopold 1966, "River meanders - theory of minimum variance"]
struct Meander {
    double wavelength = 1.0; ///< along the strip, scene units, > 0
    double amplitude = 0.0;  ///< radians, in [0, 1.2]

    struct Point {
        double along = 0.0;
        double across = 0.0;
        double slope = 0.0; ///< radians
    };
    /// The point at length `s` along the strip.
    [[nodiscard]] Point at(double s) const;
};

/// Maps a flat cloth to its shape; the middle surface keeps its lengths, or nearly so.
class Sheet {
public:
    /// @param width, height  of the flat cloth along x and y, scene units, > 0
    /// @param thickness      of the cloth, scene units, > 0
    /// @throws InvalidArgument: the cloth is too short along y to be folded
    Sheet(GenerateShape shape, double width, double height, double thickness);

    /// @param p  a point of the flat cloth: x and y lie along it, z is the height above its middle
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
    int layers_ = 1;          ///< layers of the folded stack
    double wavelength_ = 1.0; ///< of a hanging cloth's folds
    double slope_ = 0.0;      ///< slope of a hanging cloth at its hem, radians
};

} // namespace heddle::generate_parts
