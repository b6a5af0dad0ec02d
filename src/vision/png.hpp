#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/diagnostic.hpp"
#include "machine/camera.hpp"
#include "vision/window.hpp"

/// Pictures as PNG files.
namespace probewright::vision {

using machine::Picture;

/// The widest and highest picture that is read, pixels.
inline constexpr int largestPicture = 8192;

/// In shades of grey, 8 bits.
std::string toPng(const Picture& picture);

/// The picture with its monitoring areas framed in blue and errors in red, as the control's screen shows it.
std::string toPng(const Picture& picture, std::span<const Window> areas, std::span<const Window> errors);

/// A picture from the bytes of `file`; colours become grey. Fails if they are not a PNG, or one larger than
/// largestPicture.
Result<Picture> fromPng(std::string_view bytes, const std::string& file);

}  // namespace probewright::vision
