#include <heddle/job/level/svg_plot.h>

#include <heddle/base/error.h>
#include <heddle/base/format_number.h>

#include <algorithm>
#include <cmath>

namespace heddle::job {
namespace {

constexpr int kPanelWidth = 420; // px, with its labels
constexpr int kPanelHeight = 330;
constexpr int kLegendHeight = 36;
constexpr int kLeft = 66, kRight = 14, kTop = 40, kBottom = 50; // margins of a panel, px

/// Returns the next label >= value, or <= value if `below`: 1, 2 or 5 times a power of ten.
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

/// Returns labels whose range includes `lo` and `hi`; evenly spaced from 0 unless logarithmic.
std::vector<double> labels_for(double lo, double hi, bool logarithmic) {
    if (!logarithmic) {
        const double step = label_above(hi / 5.0);
        std::vector<double> labels{0.0};
        while (labels.back() < hi * (1.0 - 1e-9)) labels.push_back(labels.back() + step);
        return labels;
    }
    std::vector<double> labels{label_above(lo, true)};
    while (labels.size() < 2 || labels.back() < hi * (1.0 - 1e-9)) {
        labels.push_back(label_above(labels.back() * 1.01));
    }
    return labels;
}

/// Maps the values of a panel to px.
struct Frame {
    int left = 0;  ///< left edge of the panel, px
    int count = 1; ///< number of values of x
    bool logarithmic = false;
    std::vector<double> labels;

    [[nodiscard]] double x(int i) const {
        const double across = count > 1 ? (i - 1.0) / (count - 1) : 0.5;
        return left + kLeft + 12 + across * (kPanelWidth - kLeft - kRight - 24);
    }
    [[nodiscard]] double y(double value) const {
        const double lo = labels.front(), hi = labels.back();
        const double up = logarithmic ? std::log(std::max(value, lo) / lo) / std::log(hi / lo)
                                      : (value - lo) / (hi - lo);
        return kPanelHeight - kBottom - up * (kPanelHeight - kTop - kBottom);
    }
};

Frame frame_of(const PlotPanel& panel, int left) {
    Frame frame{left, 1, panel.logarithmic, {}};
    double lo = 0.0, hi = 0.0;
    for (const PlotLine& line : panel.lines) {
        frame.count = std::max(frame.count, static_cast<int>(line.y.size()));
        for (const auto& y : line.y) {
            if (!y || !(*y > 0.0)) continue;
            lo = lo > 0.0 ? std::min(lo, *y) : *y;
            hi = std::max(hi, *y);
        }
    }
    frame.labels = hi > 0.0 ? labels_for(lo, hi, panel.logarithmic) : labels_for(1.0, 1.0, false);
    frame.logarithmic = frame.logarithmic && hi > 0.0;
    return frame;
}

std::string escape_xml(const std::string& text) {
    std::string out;
    for (const char c : text) {
        out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return out;
}

std::string
text_at(double x, double y, const char* anchor, const std::string& text, const char* more = "") {
    return str("<text x=\"", format_fixed(x, 1), "\" y=\"", format_fixed(y, 1), "\" text-anchor=\"",
               anchor, "\"", more, ">", escape_xml(text), "</text>\n");
}

std::string
line_from(double x0, double y0, double x1, double y1, const std::string& color, double width) {
    return str("<line x1=\"", format_fixed(x0, 1), "\" y1=\"", format_fixed(y0, 1), "\" x2=\"",
               format_fixed(x1, 1), "\" y2=\"", format_fixed(y1, 1), "\" stroke=\"", color,
               "\" stroke-width=\"", format_fixed(width, 1), "\" stroke-linecap=\"round\"/>\n");
}

std::string axes_of(const PlotPanel& panel, const Frame& frame) {
    const double left = frame.left + kLeft, right = frame.left + kPanelWidth - kRight;
    const double least = frame.labels[frame.labels.front() > 0.0 ? 0 : 1];
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(least) + 1e-9)));
    std::string out;
    for (const double label : frame.labels) {
        const double y = frame.y(label);
        const bool axis = label == frame.labels.front();
        out += line_from(left, y, right, y, axis ? "#333333" : "#dddddd", 1.0);
        out += text_at(left - 8, y + 4, "end", format_fixed(label, decimals));
    }
    const double bottom = frame.y(frame.labels.front());
    for (int i = 1; i <= frame.count; ++i) {
        out += line_from(frame.x(i), bottom, frame.x(i), bottom + 4, "#333333", 1.0);
        out += text_at(frame.x(i), bottom + 18, "middle", std::to_string(i));
    }
    const double middle = 0.5 * (left + right);
    out += text_at(middle, bottom + 36, "middle", panel.x_label);
    return out + text_at(middle, kTop - 16, "middle", panel.title, " font-weight=\"bold\"");
}

std::string points_of(const PlotLine& line, const Frame& frame) {
    std::string out;
    for (std::size_t i = 0; i < line.y.size(); ++i) {
        if (!line.y[i]) continue;
        const int at = static_cast<int>(i) + 1;
        const double x = frame.x(at), y = frame.y(*line.y[i]);
        out += str("<circle cx=\"", format_fixed(x, 1), "\" cy=\"", format_fixed(y, 1), "\" r=\"",
                   format_fixed(0.5 * line.width + 1.5, 1), "\" fill=\"", line.color, "\"/>\n");
        if (i + 1 >= line.y.size() || !line.y[i + 1]) continue;
        out += line_from(x, y, frame.x(at + 1), frame.y(*line.y[i + 1]), line.color, line.width);
    }
    return out;
}

std::string legend_of(const std::vector<PlotLine>& lines) {
    std::string out;
    double x = kLeft;
    const double y = kPanelHeight + 0.35 * kLegendHeight;
    for (const PlotLine& line : lines) {
        out += line_from(x, y, x + 24, y, line.color, line.width);
        out += text_at(x + 32, y + 4, "start", line.name);
        x += 32.0 + 7.0 * static_cast<double>(line.name.size()) +
             24.0; // a letter is at most 7 px wide
    }
    return out;
}

} // namespace

std::string draw_svg(const std::vector<PlotPanel>& panels) {
    const int width = kPanelWidth * static_cast<int>(panels.size());
    const int height = kPanelHeight + kLegendHeight;
    std::string out =
        str("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", width, "\" height=\"", height,
            "\" viewBox=\"0 0 ", width, " ", height,
            "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" fill=\"#222222\">\n",
            "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
    int left = 0;
    for (const PlotPanel& panel : panels) {
        const Frame frame = frame_of(panel, left);
        out += axes_of(panel, frame);
        for (const PlotLine& line : panel.lines) out += points_of(line, frame);
        left += kPanelWidth;
    }
    return out + legend_of(panels.at(0).lines) + "</svg>\n";
}

} // namespace heddle::job
