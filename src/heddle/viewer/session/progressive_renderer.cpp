#include <heddle/viewer/session/progressive_renderer.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

namespace heddle::viewer {
namespace {

constexpr std::int32_t kMaxScale = 16;

/// The seconds that `run` takes, including the driver's work.
template <typename Run>
double timed(Run&& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    glFinish();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

ProgressiveRenderer::ProgressiveRenderer(std::int32_t width, std::int32_t height)
    : fine_(width, height) {}

bool ProgressiveRenderer::work(double seconds, const Draw& draw) {
    if (stage_ == Phase::Done) return false;
    try {
        if (stage_ == Phase::Coarse)
            draw_coarse(seconds, draw);
        else
            draw_band(seconds, draw);
    } catch (...) {
        fine_.limit(0, fine_.height());
        restart();
        throw;
    }
    return true;
}

void ProgressiveRenderer::draw_coarse(double seconds, const Draw& draw) {
    const std::int32_t width = (fine_.width() + scale_ - 1) / scale_;
    const std::int32_t height = (fine_.height() + scale_ - 1) / scale_;
    if (!coarse_ || coarse_->width() != width || coarse_->height() != height) {
        coarse_ = std::make_unique<RenderTarget>(width, height);
    }
    const double took = timed([&] {
        coarse_->clear();
        draw(*coarse_, true);
    });
    rows_ = 0;
    stage_ = Phase::Fine;
    // a step of the scale is a factor of four in pixels
    if (took > 1.2 * seconds) scale_ = std::min(2 * scale_, kMaxScale);
    if (took < 0.2 * seconds) scale_ = std::max(scale_ / 2, 1);
}

void ProgressiveRenderer::draw_band(double seconds, const Draw& draw) {
    const std::int32_t end = std::min(rows_ + band_, fine_.height());
    const double took = timed([&] {
        fine_.limit(rows_, end);
        fine_.clear();
        draw(fine_, false);
        fine_.limit(0, fine_.height());
    });
    rows_ = end;
    if (rows_ == fine_.height()) stage_ = Phase::Done;
    if (took > seconds) band_ = std::max(band_ / 2, 8);
    if (took < 0.4 * seconds) band_ = std::min(2 * band_, fine_.height());
}

} // namespace heddle::viewer
