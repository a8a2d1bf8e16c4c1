#pragma once

#include <heddle/opengl/context.h>
#include <heddle/viewer/session/job.h>
#include <heddle/viewer/session/progressive_renderer.h>
#include <heddle/viewer/session/settings.h>
#include <heddle/viewer/slice/slice_renderer.h>
#include <heddle/viewer/volume/voxel_renderer.h>
#include <heddle/voxel/voxel_level.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace heddle::viewer {

/// The objects that are shown: yarns and hair, a volume, or both.
struct ViewedObject {
    std::string name;                          ///< name of the file, for titles and saved files
    std::optional<Geometry> geometry;          ///< yarns of the models slice and solid, or hair
    std::shared_ptr<const VoxelLevels> levels; ///< may be null
    std::uint64_t seed = 0;
    std::int64_t memory_bytes = 0; ///< SliceRendererOptions::memory_bytes
    std::string folder = ".";      ///< where files are saved
};

/// A box around the control points or, without any, around the leaves of 8^3 voxels.
[[nodiscard]] Bounds bounds_of(const ViewedObject& subject);

/// The state and work of a view, without a window: settings in; pictures, voxels and files out. A
/// failure leaves one line as message(), and everything else unchanged.
class Session {
public:
    /// @param context  must outlive the session
    /// @throws Error   as SliceRenderer and VoxelRenderer
    Session(const opengl::Context& context,
            ViewedObject subject,
            const Settings& settings,
            std::int32_t width,
            std::int32_t height);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Sets other settings; the picture starts again if they change it.
    void set(const Settings& settings);
    [[nodiscard]] const Settings& settings() const { return settings_; }
    /// @throws Error  as RenderTarget
    void resize(std::int32_t width, std::int32_t height);

    /// Takes the result of a job if there is one, and draws for about `seconds`.
    /// @return        whether the picture has changed
    /// @throws Error  Device: the context is lost
    bool work(double seconds);
    /// Draws the complete picture at once.
    /// @param times   of slices; may be null
    /// @throws Error  any failure
    [[nodiscard]] RgbImage draw_now(SliceTimes* times = nullptr);
    [[nodiscard]] const ProgressiveRenderer& picture() const { return *picture_; }
    [[nodiscard]] bool busy() const { return job_ != nullptr || !picture_->done(); }

    /// Starts to voxelize the visible part, or all.
    void voxelize();
    void stop_job();
    [[nodiscard]] const Job* job() const { return job_.get(); }
    [[nodiscard]] bool has_voxels() const { return voxels_ != nullptr; }
    [[nodiscard]] bool has_slices() const { return slices_ != nullptr; }

    /// Saves the picture as NAME_view.png when it is complete.
    void save_picture();
    /// Saves the voxels as NAME_view.vdb; on a thread, as voxelize().
    void save_voxels() { save(false); }
    /// Saves NAME_view.vdb, and NAME_view.toml for `heddle render`.
    void save_scene() { save(true); }

    /// A scene file that shows a volume like the view.
    [[nodiscard]] std::string scene(const std::string& volume) const;

    void frame_all();
    /// Makes the block under a pixel white, or none if it is white or missing.
    /// @param x, y  pixels from the upper left corner of the picture
    void pick_block(double x, double y);
    [[nodiscard]] const std::string& message() const { return message_; }
    [[nodiscard]] const ViewedObject& subject() const { return subject_; }
    [[nodiscard]] std::int64_t slice_count() const;
    [[nodiscard]] int level_count() const;   ///< number of levels of the voxels; 0: there are none
    [[nodiscard]] std::string blend() const; ///< the blending of slices, in words
    /// The names of the kinds of yarn that Settings::yarns edits.
    [[nodiscard]] const std::vector<std::string>& kinds() const { return kinds_; }

private:
    void draw(const RenderTarget& target, bool coarse, SliceTimes* times = nullptr);
    void fit_slices();
    [[nodiscard]] Ball ball() const;
    void frame_first();
    void start(std::function<JobResult(Progress&)> run);
    void take_result();
    void save(bool scene);
    void write_picture();
    void show_voxels();
    template <typename Run>
    bool attempt(Run&& run);
    [[nodiscard]] double aspect() const;
    [[nodiscard]] std::string path_with(const char* suffix) const;

    const opengl::Context& context_;
    ViewedObject subject_;
    Settings settings_;
    std::vector<std::string> kinds_;
    std::unique_ptr<SliceRenderer> slices_;
    std::unique_ptr<VoxelRenderer> voxels_;
    std::unique_ptr<ProgressiveRenderer> picture_;
    std::unique_ptr<Job> job_;
    bool picture_wanted_ = false;
    std::string message_;
};

} // namespace heddle::viewer
