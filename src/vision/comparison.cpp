#include "vision/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace probewright::vision {

namespace {

constexpr double factor = 5;
constexpr double cameraNoise = 2;    // grey levels
constexpr double edgeOffset = 0.35;  // pixels
constexpr double fewestPixels = 6;
constexpr float dark = 12;  // grey levels that say nothing of how bright a picture is
constexpr double dimmest = 0.5, brightest = 2;

cv::Mat smoothed(const Picture& picture) {
  const cv::Mat bytes(picture.height, picture.width, CV_8UC1, const_cast<std::uint8_t*>(picture.grey.data()));
  cv::Mat grey;
  bytes.convertTo(grey, CV_32F);
  cv::GaussianBlur(grey, grey, {0, 0}, 1.0, 1.0, cv::BORDER_REPLICATE);
  return grey;
}

cv::Mat maskOf(const std::vector<Window>& areas, int width, int height) {
  cv::Mat mask = cv::Mat::zeros(height, width, CV_8UC1);
  for (const Window& area : areas)
    mask(cv::Rect(area.x, area.y, area.width, area.height) & cv::Rect(0, 0, width, height)).setTo(255);
  return mask;
}

/// The factor that makes `grey` as bright as `like`: the median over the pixels that are neither dark nor white.
float brightness(const cv::Mat& like, const cv::Mat& grey, const cv::Mat& mask) {
  std::vector<float> ratios;
  for (int y = 0; y < like.rows; ++y) {
    for (int x = 0; x < like.cols; ++x) {
      if (mask.at<std::uint8_t>(y, x) == 0) continue;
      const float wanted = like.at<float>(y, x), is = grey.at<float>(y, x);
      if (wanted > dark && is > dark && wanted < 250 && is < 250) ratios.push_back(wanted / is);
    }
  }
  if (ratios.size() < 50) return 1;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return std::clamp(*middle, static_cast<float>(dimmest), static_cast<float>(brightest));
}

cv::Mat matOf(const std::vector<float>& values, int width, int height) {
  return {height, width, CV_32F, const_cast<float*>(values.data())};
}

std::vector<float> valuesOf(const cv::Mat& mat) { return {mat.begin<float>(), mat.end<float>()}; }

}  // namespace

Average::Average(std::span<const Picture* const> references, std::vector<Window> areas) : areas_(std::move(areas)) {
  if (references.empty()) throw std::logic_error("an average needs a picture");
  width_ = references.front()->width;
  height_ = references.front()->height;
  const cv::Mat mask = maskOf(areas_, width_, height_);
  const cv::Mat first = smoothed(*references.front());
  cv::Mat sum = cv::Mat::zeros(height_, width_, CV_64F), squares = sum.clone();
  for (const Picture* reference : references) {
    cv::Mat grey = smoothed(*reference);
    grey *= brightness(first, grey, mask);
    cv::accumulate(grey, sum);
    cv::accumulateSquare(grey, squares);
  }
  const double count = static_cast<double>(references.size());
  cv::Mat mean, variance = cv::Mat::zeros(height_, width_, CV_32F);
  sum.convertTo(mean, CV_32F, 1 / count);
  if (references.size() > 1) {
    const cv::Mat exact = (squares - sum.mul(sum) / count) / (count - 1);
    exact.convertTo(variance, CV_32F);
    variance = cv::max(variance, 0.0);
  }
  cv::Mat across, down;
  cv::Sobel(mean, across, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(mean, down, CV_32F, 0, 1, 3, 1.0 / 8);
  const cv::Mat slope = across.mul(across) + down.mul(down);
  const cv::Mat spread = variance + cameraNoise * cameraNoise + edgeOffset * edgeOffset * slope;
  mean_ = valuesOf(mean);
  spread_ = valuesOf(spread);
}

Picture Average::picture() const {
  Picture picture{width_, height_, {}};
  picture.grey.reserve(mean_.size());
  for (const float value : mean_)
    picture.grey.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)));
  return picture;
}

std::vector<Window> Average::errorsOf(const Picture& picture, double sensitivity) const {
  if (picture.width != width_ || picture.height != height_)
    throw std::logic_error("pictures that are compared have one size");
  const cv::Mat mask = maskOf(areas_, width_, height_);
  const cv::Mat mean = matOf(mean_, width_, height_);
  cv::Mat grey = smoothed(picture);
  grey *= brightness(mean, grey, mask);
  const cv::Mat difference = grey - mean;
  const double limit = factor / sensitivity;
  cv::Mat deviates = difference.mul(difference) > limit * limit * matOf(spread_, width_, height_);
  cv::bitwise_and(deviates, mask, deviates);
  cv::morphologyEx(deviates, deviates, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, {2, 2}));
  cv::morphologyEx(deviates, deviates, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  cv::bitwise_and(deviates, mask, deviates);
  cv::Mat labels, statistics, centroids;
  const int count = cv::connectedComponentsWithStats(deviates, labels, statistics, centroids, 8, CV_32S);
  std::vector<std::pair<int, Window>> found;
  for (int i = 1; i < count; ++i) {
    const auto of = [&](int column) { return statistics.at<int>(i, column); };
    if (of(cv::CC_STAT_AREA) < fewestPixels / sensitivity) continue;
    found.emplace_back(of(cv::CC_STAT_AREA), Window{of(cv::CC_STAT_LEFT), of(cv::CC_STAT_TOP), of(cv::CC_STAT_WIDTH),
                                                    of(cv::CC_STAT_HEIGHT)});
  }
  std::ranges::stable_sort(found, std::greater(), &std::pair<int, Window>::first);
  std::vector<Window> errors;
  for (const auto& [pixels, window] : found)
    errors.push_back(window);
  return errors;
}

}  // namespace probewright::vision
