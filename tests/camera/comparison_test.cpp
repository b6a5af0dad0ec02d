#include "vision/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "vision/png.hpp"

/// Pictures made by hand: what counts as a deviation, to the grey level and the pixel.
namespace probewright::vision {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr int width = 120, height = 90;
const std::vector<Window> everywhere = {{0, 0, width, height}};

/// A slope of grey with noise.
Picture scene(unsigned seed, double noise = 1, double brightness = 1) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0, noise);
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.grey.push_back(static_cast<std::uint8_t>(
          std::lround(std::clamp(brightness * (80 + 0.5 * x) + (noise > 0 ? normal(engine) : 0), 0.0, 255.0))));
  return picture;
}

void add(Picture& picture, const Window& window, int grey) {
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      auto& pixel = picture.grey[static_cast<std::size_t>(y * picture.width + x)];
      pixel = static_cast<std::uint8_t>(std::clamp(pixel + grey, 0, 255));
    }
  }
}

Average averageOf(const std::vector<Picture>& pictures, std::vector<Window> areas = everywhere) {
  std::vector<const Picture*> all;
  for (const Picture& picture : pictures)
    all.push_back(&picture);
  return {all, std::move(areas)};
}

std::vector<Picture> references(int count) {
  std::vector<Picture> pictures;
  for (int i = 0; i < count; ++i)
    pictures.push_back(scene(static_cast<unsigned>(i)));
  return pictures;
}

TEST(Comparison, FindsWhatIsBrighterOrDarkerAndWhere) {
  const Average average = averageOf(references(5));
  EXPECT_THAT(average.errorsOf(scene(99), 1), IsEmpty());
  for (const int grey : {40, -40}) {
    Picture picture = scene(99);
    add(picture, {30, 40, 12, 8}, grey);
    const auto errors = average.errorsOf(picture, 1);
    ASSERT_THAT(errors, SizeIs(1)) << grey;
    EXPECT_NEAR(errors[0].x, 30, 2);
    EXPECT_NEAR(errors[0].y, 40, 2);
    EXPECT_NEAR(errors[0].width, 12, 4);
    EXPECT_NEAR(errors[0].height, 8, 4);
  }
}

TEST(Comparison, LooksWithinTheAreasOnly) {
  Picture picture = scene(99);
  add(picture, {30, 40, 12, 8}, 60);
  EXPECT_THAT(averageOf(references(3), {{60, 0, 60, 90}}).errorsOf(picture, 1), IsEmpty());
  EXPECT_THAT(averageOf(references(3), {}).errorsOf(picture, 1), IsEmpty());
  const auto errors = averageOf(references(3), {{60, 0, 60, 90}, {0, 0, 36, 90}}).errorsOf(picture, 1);
  ASSERT_THAT(errors, SizeIs(1));
  EXPECT_EQ(errors[0].x + errors[0].width, 36) << "what lies beyond the area does not belong to it";
}

/// Flat, without noise: the limit is 5 times the 2 grey levels that are always assumed.
TEST(Comparison, TakesFiveTimesTheNoiseAsItsLimit) {
  const Picture flat{width, height, std::vector<std::uint8_t>(std::size_t{width} * height, 100)};
  const Average average = averageOf({flat, flat});
  const auto found = [&](int grey, double sensitivity) {
    Picture picture = flat;
    add(picture, {40, 30, 20, 20}, grey);
    return !average.errorsOf(picture, sensitivity).empty();
  };
  EXPECT_FALSE(found(9, 1));
  EXPECT_TRUE(found(12, 1));
  EXPECT_TRUE(found(6, 2));
  EXPECT_FALSE(found(12, 0.5));
  EXPECT_TRUE(found(23, 0.5));
}

TEST(Comparison, TakesWhatReferencesDifferInIntoAccount) {
  std::vector<Picture> pictures = references(6);
  // A hose lies here one time and there another time.
  for (std::size_t i = 0; i < pictures.size(); i += 2)
    add(pictures[i], {50, 10, 15, 60}, 50);
  Picture picture = scene(99);
  add(picture, {50, 10, 15, 60}, 50);
  EXPECT_THAT(averageOf(pictures).errorsOf(picture, 1), IsEmpty());
  EXPECT_THAT(averageOf(references(6)).errorsOf(picture, 1), SizeIs(1));
}

TEST(Comparison, PermitsLightThatIsWeakerAsAWhole) {
  const Average average = averageOf(references(4));
  for (const double brightness : {0.6, 0.85, 1.2})
    EXPECT_THAT(average.errorsOf(scene(99, 1, brightness), 1), IsEmpty()) << brightness;
  EXPECT_THAT(average.errorsOf(scene(99, 1, 0.3), 1), Not(IsEmpty())) << "beyond one half";
}

TEST(Comparison, PermitsEdgesAThirdOfAPixelOff) {
  const auto step = [](double at) {
    Picture picture{width, height, {}};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        picture.grey.push_back(static_cast<std::uint8_t>(60 + 120 * std::clamp(x + 1 - at, 0.0, 1.0)));
    return picture;
  };
  const Average average = averageOf({step(50), step(50)});
  EXPECT_THAT(average.errorsOf(step(50.3), 1), IsEmpty());
  EXPECT_THAT(average.errorsOf(step(54), 1), SizeIs(1));
}

TEST(Comparison, DropsSpecks) {
  const Average average = averageOf(references(4));
  Picture picture = scene(99);
  add(picture, {20, 20, 1, 1}, 90);
  EXPECT_THAT(average.errorsOf(picture, 1), IsEmpty());
  add(picture, {60, 60, 4, 4}, 90);
  EXPECT_THAT(average.errorsOf(picture, 1), SizeIs(1));
}

TEST(Comparison, ListsTheLargestErrorFirst) {
  const Average average = averageOf(references(4));
  Picture picture = scene(99);
  add(picture, {10, 10, 6, 6}, 90);
  add(picture, {60, 50, 20, 20}, 90);
  const auto errors = average.errorsOf(picture, 1);
  ASSERT_THAT(errors, SizeIs(2));
  EXPECT_GT(errors[0].x, errors[1].x);
}

TEST(Png, KeepsEveryPixel) {
  const Picture picture = scene(5, 20);
  const auto back = fromPng(toPng(picture), "a.png");
  ASSERT_TRUE(back) << format(back.error());
  EXPECT_EQ(*back, picture);
}

/// The outermost pixels of an area, those around an error, cut off at the ends of the picture; nothing else changes.
TEST(Png, FramesAreasAndErrorsToThePixel) {
  constexpr int wide = 20, high = 14;
  constexpr std::uint8_t plain = 200;  // neither blue nor red has this grey
  const Picture grey{wide, high, std::vector<std::uint8_t>(std::size_t{wide} * high, plain)};
  const auto changed = [&](const std::vector<Window>& areas, const std::vector<Window>& errors) {
    const auto framed = fromPng(toPng(grey, areas, errors), "a.png");
    std::vector<std::string> rows(high, std::string(wide, '.'));
    for (int y = 0; y < high; ++y)
      for (int x = 0; x < wide; ++x)
        if (framed->grey[static_cast<std::size_t>(y * wide + x)] != plain)
          rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = '#';
    return rows;
  };
  const auto frame = [](int left, int top, int right, int bottom) {
    std::vector<std::string> rows(high, std::string(wide, '.'));
    for (int y = 0; y < high; ++y)
      for (int x = 0; x < wide; ++x)
        if (x >= left && x <= right && y >= top && y <= bottom && (x == left || x == right || y == top || y == bottom))
          rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] = '#';
    return rows;
  };
  EXPECT_EQ(changed({{3, 2, 5, 4}}, {}), frame(3, 2, 7, 5));
  EXPECT_EQ(changed({}, {{3, 2, 5, 4}}), frame(2, 1, 8, 6));
  EXPECT_EQ(changed({{0, 0, wide, high}}, {}), frame(0, 0, wide - 1, high - 1));
  EXPECT_EQ(changed({}, {{0, 0, 5, 4}}), frame(-1, -1, 5, 4));
  EXPECT_EQ(changed({}, {{wide - 5, high - 4, 5, 4}}), frame(wide - 6, high - 5, wide, high));
}

TEST(Png, FramesAreasAndErrors) {
  const Picture grey{20, 10, std::vector<std::uint8_t>(200, 90)};
  const std::vector<Window> areas = {{2, 2, 10, 6}}, errors = {{18, 8, 5, 5}};
  const auto framed = fromPng(toPng(grey, areas, errors), "a.png");
  ASSERT_TRUE(framed);
  EXPECT_NE(framed->at(2, 2), 90);
  EXPECT_NE(framed->at(11, 7), 90);
  EXPECT_EQ(framed->at(5, 5), 90);
  EXPECT_NE(framed->at(17, 7), 90) << "an error reaches over the edge";
}

TEST(Png, RefusesWhatIsNone) {
  const std::string whole = toPng(scene(1));
  for (const std::string& bytes : {std::string(), std::string("not a picture"), whole.substr(0, whole.size() / 2)}) {
    const auto read = fromPng(bytes, "a.png");
    ASSERT_FALSE(read);
    EXPECT_THAT(format(read.error()), HasSubstr("a.png: error: this picture cannot be read"));
  }
}

/// As many pixels as are allowed in one direction, and one more: each direction counts for itself.
TEST(Png, RefusesPicturesThatAreTooWideOrTooHigh) {
  for (const bool wide : {true, false}) {
    for (const int more : {0, 1}) {
      const std::size_t pixels = largestPicture + more;
      const int across = wide ? largestPicture + more : 1, down = wide ? 1 : largestPicture + more;
      const auto read = fromPng(toPng({across, down, std::vector<std::uint8_t>(pixels, 90)}), "a.png");
      EXPECT_EQ(read.has_value(), more == 0) << across << " x " << down;
    }
  }
}

}  // namespace
}  // namespace probewright::vision
