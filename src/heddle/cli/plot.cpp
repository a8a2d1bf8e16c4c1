#include <heddle/base/show_number.h>
#include <heddle/cli/plot.h>

#include <heddle/base/vec.h>
#include <heddle/cli/font.h>
#include <heddle/cli/terminal/text.h>

#include <algorithm>
#include <cmath>

namespace heddle::cli {
namespace {

constexpr int kPanelWidth = 560; // px, with its labels
constexpr int kPanelHeight = 440;
constexpr int kLegendHeight = 50;
constexpr int kLeft = 90; // of a panel's frame, for the labels beside it
constexpr int kRight = 20;
constexpr int kTop = 50;
constexpr int kBottom = 70;
constexpr int kLetter = 2; // px per font pixel

using Color = std::array<std::uint8_t, 3>;
constexpr Color kBlack{30, 30, 30};
constexpr Color kGrey{215, 215, 215};

struct Point {
    double x = 0.0;
    double y = 0.0;
};

int text_width(const std::string& text) {
    return static_cast<int>(text.size()) * (kFontWidth + 1) * kLetter;
}

class Canvas {
public:
    Canvas(int width, int height) {
        image.width = width;
        image.height = height;
        image.rgb.assign(static_cast<std::size_t>(width * height) * 3, 255);
    }

    /// A line with round ends; its edges fade over one pixel.
    void line(Point a, Point b, double width, Color color) {
        const double reach = 0.5 * width + 1.0;
        const Point d{b.x - a.x, b.y - a.y};
        const double square = std::max(1e-12, d.x * d.x + d.y * d.y);
        const auto lo = [&](double p, double q) { return int(std::floor(std::min(p, q) - reach)); };
        const auto hi = [&](double p, double q) { return int(std::ceil(std::max(p, q) + reach)); };
        for (int y = lo(a.y, b.y); y <= hi(a.y, b.y); ++y) {
            for (int x = lo(a.x, b.x); x <= hi(a.x, b.x); ++x) {
                const Point p{x + 0.5 - a.x, y + 0.5 - a.y};
                const double t = std::clamp((p.x * d.x + p.y * d.y) / square, 0.0, 1.0);
                const double far = std::hypot(p.x - t * d.x, p.y - t * d.y);
                blend(x, y, std::clamp(0.5 * width + 0.5 - far, 0.0, 1.0), color);
            }
        }
    }

    /// @param left, top  of the first letter
    void text(const std::string& words, int left, int top, Color color = kBlack) {
        for (const char letter : words) {
            const auto rows = glyph_of(letter);
            for (int y = 0; y < kFontHeight * kLetter; ++y) {
                for (int x = 0; x < kFontWidth * kLetter; ++x) {
                    const int row = rows[static_cast<std::size_t>(y / kLetter)];
                    if ((row >> (kFontWidth - 1 - x / kLetter) & 1) == 0) continue;
                    blend(left + x, top + drop_of(letter) * kLetter + y, 1.0, color);
                }
            }
            left += (kFontWidth + 1) * kLetter;
        }
    }

    PlotImage image;

private:
    void blend(int x, int y, double alpha, Color color) {
        if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
        const auto at = static_cast<std::size_t>(y * image.width + x) * 3;
        for (std::size_t c = 0; c < 3; ++c) {
            const double mixed = image.rgb[at + c] * (1.0 - alpha) + color[c] * alpha;
            image.rgb[at + c] = static_cast<std::uint8_t>(mixed + 0.5);
        }
    }
};

/// The label at or above a value, or at or below it: 1, 2 or 5 times a power of ten.
double label_above(double value, bool below = false) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    double last = power;
    for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
        const double label = factor * power;
        if (label >= value * (1.0 - 1e-9))
            return below && label > value * (1.0 + 1e-9) ? last : label;
        last = label;
    }
    return 10.0 * power;
}

/// Where values of a panel lie in the picture.
struct Frame {
    int left = 0;  ///< px, of the panel
    int count = 1; ///< values of x
    std::vector<double> labels;
    bool logarithmic = false;

    /// Place of y between the lowest label, 0, and the highest, 1.
    [[nodiscard]] double up(double y) const {
        const double lo = labels.front();
        const double hi = labels.back();
        if (!logarithmic) return (y - lo) / (hi - lo);
        return std::log(std::max(y, lo) / lo) / std::log(hi / lo);
    }
    [[nodiscard]] Point at(double x, double y) const {
        const double across = count > 1 ? (x - 1.0) / (count - 1) : 0.5;
        return {left + kLeft + 15 + across * (kPanelWidth - kLeft - kRight - 30),
                kPanelHeight - kBottom - up(y) * (kPanelHeight - kTop - kBottom)};
    }
};

/// Labels that reach from at or below `lo` to `hi`; evenly from 0 unless logarithmic.
std::vector<double> labels_for(double lo, double hi, bool logarithmic) {
    if (!logarithmic) {
        const double step = label_above(hi / 5.0);
        return {0.0, step, 2.0 * step, 3.0 * step, 4.0 * step, 5.0 * step};
    }
    std::vector<double> labels{label_above(lo, true)};
    while (labels.size() < 2 || labels.back() < hi * (1.0 - 1e-9)) {
        labels.push_back(label_above(labels.back() * 1.01));
    }
    return labels;
}

Frame frame_of(const PlotPanel& panel, int left) {
    Frame frame{left, 1, {}, panel.logarithmic};
    double lo = 0.0;
    double hi = 0.0;
    for (const PlotLine& line : panel.lines) {
        frame.count = std::max(frame.count, static_cast<int>(line.y.size()));
        for (const auto& y : line.y) {
            if (!y || !(*y > 0.0)) continue;
            lo = lo > 0.0 ? std::min(lo, *y) : *y;
            hi = std::max(hi, *y);
        }
    }
    frame.labels = hi > 0.0 ? labels_for(lo, hi, panel.logarithmic) : labels_for(1.0, 1.0, false);
    return frame;
}

void draw_axes(Canvas& canvas, const PlotPanel& panel, const Frame& frame) {
    const double left = frame.left + kLeft;
    const double right = frame.left + kPanelWidth - kRight;
    const double least = frame.labels[frame.labels.front() > 0.0 ? 0 : 1];
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(least) + 1e-9)));
    for (const double label : frame.labels) {
        const double y = frame.at(1, label).y;
        canvas.line({left, y}, {right, y}, 1.0, label == frame.labels.front() ? kBlack : kGrey);
        const std::string text = show_fixed(label, decimals);
        canvas.text(text, static_cast<int>(left) - 8 - text_width(text), static_cast<int>(y) - 7);
    }
    for (int x = 1; x <= frame.count; ++x) {
        const Point p = frame.at(x, frame.labels.front());
        canvas.line(p, {p.x, p.y + 5}, 1.0, kBlack);
        const std::string label = std::to_string(x);
        canvas.text(label, static_cast<int>(p.x) - text_width(label) / 2,
                    static_cast<int>(p.y) + 10);
    }
    const int middle = static_cast<int>(0.5 * (left + right));
    canvas.text(panel.title, middle - text_width(panel.title) / 2, kTop - 30);
    canvas.text(panel.x_label, middle - text_width(panel.x_label) / 2, kPanelHeight - kBottom + 38);
}

void draw_line(Canvas& canvas, const PlotLine& line, const Frame& frame) {
    for (std::size_t i = 0; i < line.y.size(); ++i) {
        if (!line.y[i]) continue;
        const Point p = frame.at(static_cast<double>(i + 1), *line.y[i]);
        canvas.line(p, p, line.width + 5.0, line.color);
        if (i + 1 >= line.y.size() || !line.y[i + 1]) continue;
        canvas.line(p, frame.at(static_cast<double>(i + 2), *line.y[i + 1]), line.width,
                    line.color);
    }
}

} // namespace

PlotImage draw_plot(const std::vector<PlotPanel>& panels) {
    Canvas canvas(kPanelWidth * static_cast<int>(panels.size()), kPanelHeight + kLegendHeight);
    int left = 0;
    for (const PlotPanel& panel : panels) {
        const Frame frame = frame_of(panel, left);
        draw_axes(canvas, panel, frame);
        for (const PlotLine& line : panel.lines) draw_line(canvas, line, frame);
        left += kPanelWidth;
    }
    int x = kLeft;
    for (const PlotLine& line : panels.at(0).lines) {
        const double y = kPanelHeight + 0.4 * kLegendHeight;
        canvas.line({double(x), y}, {x + 30.0, y}, line.width, line.color);
        canvas.text(line.name, x + 40, static_cast<int>(y) - 7);
        x += 40 + text_width(line.name) + 30;
    }
    return std::move(canvas.image);
}

} // namespace heddle::cli
