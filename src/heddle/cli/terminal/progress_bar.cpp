#include <heddle/base/format_number.h>
#include <heddle/cli/terminal/progress_bar.h>
#include <heddle/cli/terminal/text.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>

namespace heddle::cli {
namespace {

constexpr std::int64_t kRedrawMs = 100;

std::atomic<Progress*> signalled{nullptr};

extern "C" void on_signal(int number) {
    std::signal(number, SIG_DFL); // whoever asks twice does not want to wait
    if (Progress* progress = signalled.load()) progress->cancel();
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

void ProgressBar::begin(std::string_view phase, std::string_view unit, std::int64_t total) {
    finish();
    phase_ = phase;
    unit_ = unit;
    total_ = total;
    done_ = 0;
    next_draw_ms_ = kRedrawMs; // what takes less is not worth a flicker
    start_ = Clock::now();
}

void ProgressBar::begin_part(std::string_view name) {
    finish();
    part_ = std::string(name) + "  ";
}

void ProgressBar::note(std::string_view sentence) {
    wipe();
    if (on_note_) on_note_(std::string(sentence));
}

void ProgressBar::advance(std::int64_t units) {
    done_.fetch_add(units, std::memory_order_relaxed);
    if (!visible_) return;
    const double seconds = seconds_since(start_);
    if (seconds * 1e3 < static_cast<double>(next_draw_ms_.load(std::memory_order_relaxed))) return;
    const std::unique_lock lock(drawing_, std::try_to_lock);
    if (!lock) return;
    next_draw_ms_ = static_cast<std::int64_t>(seconds * 1e3) + kRedrawMs;
    draw(seconds);
}

void ProgressBar::draw(double seconds) const {
    constexpr int kWidth = 24;
    const auto done = static_cast<double>(done_.load(std::memory_order_relaxed));
    const double part = total_ > 0 ? std::clamp(done / static_cast<double>(total_), 0.0, 1.0) : 0.0;
    std::array<char, kWidth + 1> bar{};
    for (int i = 0; i < kWidth; ++i)
        bar[static_cast<std::size_t>(i)] = i < part * kWidth ? '#' : '.';
    const double rate = done / seconds;
    const double left = part > 0.0 ? seconds * (1.0 - part) / part : 0.0;
    std::fprintf(stderr, "\r%s%-10s [%s] %3.0f %%  %s %s/s  %s left\x1b[K", part_.c_str(),
                 phase_.c_str(), bar.data(), part * 100.0, format_count(rate).c_str(),
                 unit_.c_str(), part > 0.0 ? format_seconds(left).c_str() : "?");
    std::fflush(stderr);
}

void ProgressBar::wipe() const {
    if (!phase_.empty() && visible_ && next_draw_ms_ > kRedrawMs) std::fputs("\r\x1b[K", stderr);
}

void ProgressBar::finish() {
    wipe();
    phase_.clear();
}

void cancel_on_signals(Progress& progress) {
    signalled = &progress;
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
}

} // namespace heddle::cli
