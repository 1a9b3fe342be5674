// What pictures in SVG share: colours, axes, text.
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// Of the n-th series; told apart by people who see colours otherwise.
std::string_view svg_colour(size_t series);

// 1, 2 or 5 times a power of ten, such that about five fit into the range.
double tick_step(double range);

// A range of values along an edge of a panel.
struct SvgAxis {
  double low, high;       // values
  double from_px, to_px;  // where they are
  double operator()(double value) const {
    return from_px + (value - low) / (high - low) * (to_px - from_px);
  }
};

// Text made safe to stand in a picture.
std::string svg_escaped(const std::string& text);

// `anchor`: start, middle or end. Any text is safe.
std::string svg_text(double x, double y, std::string_view anchor, const std::string& text);

// A whole picture on white, in pixels, `title` at its top from `left` on.
std::string svg_picture(double width, double height, double left, const std::string& title,
                        const std::string& content);

}  // namespace io
}  // namespace walktrack
