// What SVG images have in common: colours, axes, text.
#pragma once

#include <string>
#include <string_view>

namespace walktrack {
inline namespace io {

// The colour of the n-th series; colour-blind people can distinguish them.
std::string_view svg_colour(size_t series);

// 1, 2 or 5 times a power of ten, so that about five ticks fit into the range.
double tick_step(double range);

// A range of values along an edge of a panel.
struct SvgAxis {
  double low, high;       // values
  double from_px, to_px;  // their positions
  double operator()(double value) const {
    return from_px + (value - low) / (high - low) * (to_px - from_px);
  }
};

// Text with special characters escaped.
std::string svg_escaped(const std::string& text);

// `anchor`: start, middle or end. Escapes special characters.
std::string svg_text(double x, double y, std::string_view anchor, const std::string& text);

// A complete image with a white background, sizes in pixels, and `title` at its top from `left` on.
std::string svg_picture(double width, double height, double left, const std::string& title,
                        const std::string& content);

}  // namespace io
}  // namespace walktrack
