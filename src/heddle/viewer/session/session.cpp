#include <heddle/viewer/session/session.h>

#include <heddle/base/error.h>
#include <heddle/io/file/output_file.h>
#include <heddle/io/image/image.h>
#include <heddle/io/vdb/write_vdb.h>
#include <heddle/viewer/session/save_scene.h>
#include <heddle/viewer/session/voxelize_visible.h>
#include <heddle/viewer/volume/voxel_tables.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace heddle::viewer {
namespace {

constexpr std::int32_t kCoarseMap = 256; ///< size of the shadow map while the view moves, pixels

/// Whether two settings give the same picture of slices or voxels.
bool same_picture(const Settings& a, const Settings& b) {
    return a.orbit == b.orbit && a.show == b.show && a.slices == b.slices && a.volume == b.volume &&
           a.yarns == b.yarns;
}

} // namespace

Bounds bounds_of(const ViewedObject& subject) {
    Bounds out;
    if (subject.geometry) {
        for (const CurveSet& set : subject.geometry->curves) {
            for (const Vec3f& p : set.points) out.grow(to_double(p));
        }
    }
    if (!subject.levels || !out.empty()) return out;
    const VoxelLevel& finest = *subject.levels->front();
    const Vec3d size = finest.info().lattice.voxel_size;
    VoxelBlock scratch;
    for (std::size_t b = 0; b < finest.block_count(); ++b) {
        for (const VoxelLeaf& leaf : finest.block(b, scratch).leaves) {
            const Vec3i end = leaf.origin + Vec3i{8, 8, 8};
            const Vec3i lo = leaf.origin;
            out.grow(Vec3d{lo.x * size.x, lo.y * size.y, lo.z * size.z});
            out.grow(Vec3d{end.x * size.x, end.y * size.y, end.z * size.z});
        }
    }
    return out;
}

Session::Session(const opengl::Context& context,
                 ViewedObject subject,
                 const Settings& settings,
                 std::int32_t width,
                 std::int32_t height)
    : context_(context), subject_(std::move(subject)), settings_(settings) {
    if (subject_.geometry) {
        kinds_ = names_of_kinds(*subject_.geometry);
        settings_.yarns.resize(kinds_.size());
        slices_ = std::make_unique<SliceRenderer>(
            context, edited(*subject_.geometry, settings_.yarns),
            SliceRendererOptions{.memory_bytes = subject_.memory_bytes, .seed = subject_.seed});
    }
    if (subject_.levels) show_voxels();
    if (!slices_) settings_.show = Show::Voxels;
    if (!voxels_) settings_.show = Show::Slices;
    resize(width, height);
    if (settings_.framed) frame_first();
}

Session::~Session() = default;

/// Runs an action that may fail because of its input; its one-line text then becomes the message.
/// @throws Error  Device
template <typename Run>
bool Session::attempt(Run&& run) {
    try {
        run();
        return true;
    } catch (const Error& e) {
        if (e.code() == ErrorCode::Device) throw;
        message_ = e.what();
    }
    return false;
}

double Session::aspect() const {
    return static_cast<double>(picture_->fine().width()) /
           static_cast<double>(picture_->fine().height());
}

void Session::resize(std::int32_t width, std::int32_t height) {
    if (picture_ && picture_->fine().width() == width && picture_->fine().height() == height) {
        return;
    }
    picture_ = std::make_unique<ProgressiveRenderer>(width, height);
}

void Session::set(const Settings& settings) {
    Settings next = settings;
    next.yarns.resize(kinds_.size());
    if (next.show == Show::Voxels && !has_voxels()) next.show = Show::Slices;
    if (next.show == Show::Slices && !has_slices()) next.show = Show::Voxels;
    if (next.slices.color == SliceColor::Grid && !has_voxels()) {
        next.slices.color = SliceColor::Shaded;
    }
    if (slices_ && next.yarns != settings_.yarns) {
        const bool placed =
            attempt([&] { slices_->place(edited(*subject_.geometry, next.yarns)); });
        if (!placed) next.yarns = settings_.yarns;
    }
    if (!same_picture(next, settings_)) picture_->restart();
    settings_ = next;
}

void Session::draw(const RenderTarget& target, bool coarse, SliceTimes* times) {
    const CameraParameters camera = settings_.orbit.camera();
    VoxelLook volume = settings_.volume;
    if (volume.light) volume.light = settings_.slices.light;
    if (settings_.show == Show::Voxels) {
        voxels_->draw(target, camera, volume);
    } else {
        SliceLook look = settings_.slices;
        if (coarse) look.map_size = std::min(look.map_size, kCoarseMap);
        if (voxels_) look.white_block = volume.white_block;
        slices_->draw(target, camera, look, voxels_.get(), times);
        if (voxels_ && volume.blocks) voxels_->draw_blocks(target, camera, volume);
    }
    context_.check("draw");
}

void Session::fit_slices() {
    if (slices_) slices_->fit(settings_.orbit.pixel(picture_->fine().height()));
}

bool Session::work(double seconds) {
    take_result();
    bool drawn = false;
    const bool fine = attempt([&] {
        if (!picture_->done()) fit_slices();
        drawn = picture_->work(
            seconds, [&](const RenderTarget& target, bool coarse) { draw(target, coarse); });
    });
    write_picture();
    return drawn || !fine;
}

RgbImage Session::draw_now(SliceTimes* times) {
    fit_slices();
    const RenderTarget& target = picture_->fine();
    target.clear();
    draw(target, false, times);
    picture_->restart();
    return target.image();
}

void Session::start(std::function<JobResult(Progress&)> run) {
    if (job_) {
        message_ = "another job is running: wait for it, or stop it";
        return;
    }
    message_.clear();
    job_ = std::make_unique<Job>(std::move(run));
}

void Session::voxelize() {
    if (!subject_.geometry) {
        message_ = "a volume is already open: open curves to voxelize them";
        return;
    }
    Geometry geometry = edited(*subject_.geometry, settings_.yarns);
    multiply_fibers(geometry, settings_.slices.opacity);
    const double edge = settings_.orbit.pixel(picture_->fine().height()) * settings_.voxels.edge_px;
    job::VoxelizeJobOptions options;
    options.voxel_size = Vec3d{edge, edge, edge};
    options.seed = subject_.seed;
    options.spool_dir = subject_.folder;
    options.device = job::DeviceChoice::Cpu;
    if (settings_.voxels.raster) {
        options.backend = job::Backend::Raster;
        options.composition = settings_.voxels.composition;
    }
    if (settings_.voxels.only_seen) {
        const Bounds seen = seen_bounds(geometry, settings_.orbit.camera(), aspect());
        if (seen.empty()) {
            message_ = "nothing is seen that could be voxelized: move the view";
            return;
        }
        options.bounds = seen;
    }
    start([request = VoxelRequest{std::move(geometry), std::move(options)}](Progress& progress) {
        return voxelize_visible(request, progress);
    });
}

void Session::stop_job() {
    if (!job_) return;
    job_.reset();
    message_ = "stopped";
}

void Session::take_result() {
    if (!job_) return;
    std::optional<JobResult> result = job_->poll();
    if (!result) return;
    job_.reset();
    message_ = result->message;
    if (!result->levels) return;
    std::swap(subject_.levels, result->levels);
    const bool shown = attempt([&] { show_voxels(); });
    if (shown)
        settings_.show = Show::Voxels;
    else
        subject_.levels = std::move(result->levels);
    settings_.volume.white_block.reset();
    picture_->restart();
}

void Session::show_voxels() {
    Progress silent;
    voxels_ = std::make_unique<VoxelRenderer>(context_, sources_of(*subject_.levels),
                                              VoxelRendererOptions{}, silent);
    const int first = voxels_->tables().first_level();
    if (first > 0) {
        message_ = str("levels below ", first, " exceed the driver's buffers and are not shown");
    }
}

void Session::pick_block(double x, double y) {
    if (!voxels_) return;
    Settings next = settings_;
    const std::optional<Vec3i> found = voxels_->block_at(
        settings_.orbit.camera(), picture_->fine().width(), picture_->fine().height(), x, y);
    next.volume.white_block = found == settings_.volume.white_block ? std::nullopt : found;
    set(next);
}

int Session::level_count() const {
    return voxels_ ? voxels_->tables().level_count() : 0;
}

std::string Session::path_with(const char* suffix) const {
    return (std::filesystem::path(subject_.folder) / (subject_.name + "_view" + suffix)).string();
}

void Session::save_picture() {
    picture_wanted_ = true;
    message_ = "saves the picture when it is complete";
    write_picture();
}

void Session::write_picture() {
    if (!picture_wanted_ || !picture_->done()) return;
    picture_wanted_ = false;
    attempt([&] {
        const RgbImage image = picture_->fine().image();
        write_png(path_with(".png"), image.width, image.height, 3, image.rgb);
        message_ = "saved " + path_with(".png");
    });
}

std::string Session::scene(const std::string& volume) const {
    return scene_text(volume, settings_.orbit.camera(), settings_.slices.light,
                      picture_->fine().width(), picture_->fine().height());
}

void Session::save(bool scene) {
    if (!has_voxels()) {
        message_ = "there are no voxels yet: voxelize first";
        return;
    }
    const std::string text = scene ? this->scene(subject_.name + "_view.vdb") : std::string();
    start([levels = subject_.levels, text, volume = path_with(".vdb"),
           path = path_with(".toml")](Progress& progress) -> JobResult {
        write_vdb(*levels, volume, progress);
        if (text.empty()) return {"saved " + volume, nullptr};
        OutputFile file(path);
        file.write(text.data(), text.size());
        file.commit();
        return {"saved " + path + " and its .vdb", nullptr};
    });
}

Ball Session::ball() const {
    if (slices_) return slices_->ball();
    const Ball ball = voxels_->ball();
    return ball.radius > 0.0 ? ball : Ball{{}, 1.0};
}

/// Moves the orbit from the unit ball to the objects.
void Session::frame_first() {
    const double radius = ball().radius;
    Orbit& orbit = settings_.orbit;
    if (!settings_.target_given) orbit.target = ball().middle;
    orbit.height *= radius;
    settings_.framed = false;
}

void Session::frame_all() {
    Settings next = settings_;
    next.orbit.frame(ball(), aspect());
    set(next);
}

std::string Session::blend() const {
    if (settings_.slices.weighted || (slices_ && slices_->is_split())) return "weighted";
    return settings_.slices.sorted ? "sorted" : "as placed";
}

std::int64_t Session::slice_count() const {
    return slices_ ? slices_->slice_count() : 0;
}

} // namespace heddle::viewer
