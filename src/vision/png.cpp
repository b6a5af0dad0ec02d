#include "vision/png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace probewright::vision {

namespace {

using Colour = std::array<std::uint8_t, 3>;
constexpr Colour areaColour = {40, 90, 255}, errorColour = {255, 30, 30};

std::string encode(const void* pixels, int width, int height, png_uint_32 format) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  // Asking for the size would compress the picture once more.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr) != 0) {
    bytes.resize(size);
    bytes.shrink_to_fit();
    return bytes;
  }
  throw std::runtime_error(std::string("libpng cannot write a picture: ") + &image.message[0]);
}

class Canvas {
public:
  explicit Canvas(const Picture& picture) : width_(picture.width), height_(picture.height) {
    pixels_.reserve(picture.grey.size());
    for (const std::uint8_t grey : picture.grey)
      pixels_.push_back({grey, grey, grey});
  }

  void frame(const Window& window, const Colour& colour) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      set(x, window.y, colour);
      set(x, window.y + window.height - 1, colour);
    }
    for (int y = window.y; y < window.y + window.height; ++y) {
      set(window.x, y, colour);
      set(window.x + window.width - 1, y, colour);
    }
  }

  std::string png() const { return encode(pixels_.data(), width_, height_, PNG_FORMAT_RGB); }

private:
  void set(int x, int y, const Colour& colour) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
    pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] = colour;
  }

  int width_, height_;
  std::vector<Colour> pixels_;
};

}  // namespace

std::string toPng(const Picture& picture) {
  return encode(picture.grey.data(), picture.width, picture.height, PNG_FORMAT_GRAY);
}

std::string toPng(const Picture& picture, std::span<const Window> areas, std::span<const Window> errors) {
  Canvas canvas(picture);
  for (const Window& area : areas)
    canvas.frame(area, areaColour);
  for (const Window& error : errors)
    canvas.frame({error.x - 1, error.y - 1, error.width + 2, error.height + 2}, errorColour);
  return canvas.png();
}

Result<Picture> fromPng(std::string_view bytes, const std::string& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto refuse = [&](const std::string& why) {
    png_image_free(&image);
    return fail({file, 0, 0}, fmt::format("this picture cannot be read: {}", why),
                "take the file out of the folder, or put back the one that the run has left");
  };
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return refuse(&image.message[0]);
  if (image.width > largestPicture || image.height > largestPicture)
    return refuse(fmt::format("it is larger than {0} x {0} pixels", largestPicture));
  image.format = PNG_FORMAT_GRAY;
  Picture picture{static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.grey.resize(std::size_t{image.width} * image.height);
  constexpr png_color black{};
  if (png_image_finish_read(&image, &black, picture.grey.data(), 0, nullptr) == 0) return refuse(&image.message[0]);
  return picture;
}

}  // namespace probewright::vision
