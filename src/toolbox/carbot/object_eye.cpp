#include "toolbox/carbot/object_eye.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "base/trig.hpp"

namespace vagus::toolbox::carbot {

namespace {

constexpr int kHueReach = 10;   // of 180: what still counts as that colour
constexpr int kValueMin = 40;   // of 255: darker things have no colour
constexpr int kPointsMax = 40;  // that are followed
constexpr int kPointsMin = 4;   // fewer tell nothing
constexpr double kPointQuality = 0.02;
constexpr double kPointSpacing = 2;
constexpr float kFlowErrorMax = 20;  // mean difference of grey around a point
constexpr double kJumpMin = 12;      // pixels: how far from where the flow says it may be

struct Blob {
    cv::Rect box;
    int pixels = 0;
};

// Once for the process, before the first use: what is decided by processor or number of cores would
// change the bits.
void tame_opencv() {
    static const bool done = [] {
        cv::setNumThreads(1);
        cv::setUseOptimized(false);
        return true;
    }();
    (void)done;
}

// The hue as OpenCV counts it for bytes: 0 to 180.
int hue_of(const ObjectColour& colour) {
    const auto byte = [](double part) { return static_cast<uchar>(std::lround(part * 255)); };
    cv::Mat pixel(1, 1, CV_8UC3,
                  cv::Scalar(byte(colour.red), byte(colour.green), byte(colour.blue)));
    cv::cvtColor(pixel, pixel, cv::COLOR_RGB2HSV);
    return pixel.at<cv::Vec3b>(0, 0)[0];
}

cv::Point2d middle(const cv::Rect& box) {
    return {box.x + box.width / 2.0, box.y + box.height / 2.0};
}

bool is_usable(const Image& image) {
    return image.width > 0 && image.height > 0 && image.width <= kImageSidePixelsMax &&
           image.height <= kImageSidePixelsMax &&
           image.rgb.size() == size_t{3} * static_cast<size_t>(image.width * image.height);
}

double median(std::vector<double> all) {
    const auto at = all.begin() + static_cast<ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), at, all.end());
    return *at;
}

}  // namespace

double saturation(const ObjectColour& colour) {
    const double most = std::max({colour.red, colour.green, colour.blue});
    const double least = std::min({colour.red, colour.green, colour.blue});
    return most <= 0 ? 0 : (most - least) / most;
}

struct ObjectEye::Insides {
    cv::Mat mask_of(const cv::Mat& picture) const;
    std::vector<Blob> blobs_in(const cv::Mat& mask) const;
    std::optional<cv::Point2d> flow_to(const cv::Mat& grey);
    std::optional<Sighting> keep(const cv::Mat& mask, const cv::Mat& grey, const Blob& blob);
    std::optional<Sighting> keep_by_flow(const cv::Mat& grey, const cv::Point2d& shift);
    Sighting sighting(const cv::Rect& box, const cv::Size& size) const;
    void forget();

    int hue = 0;
    cv::Mat last;                     // grey, of the last picture
    std::optional<cv::Rect> box;      // where it was there
    std::vector<cv::Point2f> points;  // of it there
    int without_colour = 0;           // pictures in a row
};

ObjectEye::ObjectEye(const ObjectColour& colour) : insides_(std::make_unique<Insides>()) {
    assert(saturation(colour) >= kColourFullness);
    tame_opencv();
    insides_->hue = hue_of(colour);
}

ObjectEye::~ObjectEye() = default;

// White where the colour is. Hue goes round: 0 and 180 are the same red.
cv::Mat ObjectEye::Insides::mask_of(const cv::Mat& picture) const {
    cv::Mat hsv;
    cv::cvtColor(picture, hsv, cv::COLOR_RGB2HSV);
    const int fullness = static_cast<int>(kColourFullness * 255);
    cv::Mat mask = cv::Mat::zeros(picture.size(), CV_8U);
    for (const int turn : {-180, 0, 180}) {
        cv::Mat part;
        cv::inRange(hsv, cv::Scalar(hue + turn - kHueReach, fullness, kValueMin),
                    cv::Scalar(hue + turn + kHueReach, 255, 255), part);
        mask |= part;
    }
    return mask;
}

// The largest first.
std::vector<Blob> ObjectEye::Insides::blobs_in(const cv::Mat& mask) const {
    cv::Mat labels;
    cv::Mat stats;
    cv::Mat middles;
    const int count = cv::connectedComponentsWithStats(mask, labels, stats, middles);
    std::vector<Blob> blobs;
    for (int i = 1; i < count; ++i) {  // 0 is all the rest
        const int pixels = stats.at<int>(i, cv::CC_STAT_AREA);
        if (pixels < kObjectPixelsMin) continue;
        blobs.push_back(
            {{stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
              stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT)},
             pixels});
    }
    std::stable_sort(blobs.begin(), blobs.end(),
                     [](const Blob& a, const Blob& b) { return a.pixels > b.pixels; });
    return blobs;
}

// How far its points have moved since the last picture; those that moved are kept.
std::optional<cv::Point2d> ObjectEye::Insides::flow_to(const cv::Mat& grey) {
    if (points.size() < kPointsMin || last.size() != grey.size()) return std::nullopt;
    std::vector<cv::Point2f> now;
    std::vector<uchar> found;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(last, grey, points, now, found, error, cv::Size(11, 11), 2);
    std::vector<double> x;
    std::vector<double> y;
    std::vector<cv::Point2f> kept;
    for (size_t i = 0; i < now.size(); ++i) {
        if (found[i] == 0 || error[i] > kFlowErrorMax) continue;
        x.push_back(now[i].x - points[i].x);
        y.push_back(now[i].y - points[i].y);
        kept.push_back(now[i]);
    }
    points = std::move(kept);
    if (points.size() < kPointsMin) return std::nullopt;
    return cv::Point2d(median(x), median(y));
}

// Takes this for the object: new points to follow, on it and on its edges.
std::optional<Sighting> ObjectEye::Insides::keep(const cv::Mat& mask, const cv::Mat& grey,
                                                 const Blob& blob) {
    cv::Mat on_it = cv::Mat::zeros(mask.size(), CV_8U);
    mask(blob.box).copyTo(on_it(blob.box));
    cv::dilate(on_it, on_it, cv::Mat());
    points.clear();
    cv::goodFeaturesToTrack(grey, points, kPointsMax, kPointQuality, kPointSpacing, on_it);
    box = blob.box;
    last = grey;
    without_colour = 0;
    return sighting(blob.box, grey.size());
}

std::optional<Sighting> ObjectEye::Insides::keep_by_flow(const cv::Mat& grey,
                                                         const cv::Point2d& shift) {
    const cv::Rect picture({0, 0}, grey.size());
    const cv::Rect moved(box->x + static_cast<int>(std::lround(shift.x)),
                         box->y + static_cast<int>(std::lround(shift.y)), box->width, box->height);
    if (++without_colour > kFlowPicturesMax || (moved & picture).empty()) {
        forget();
        return std::nullopt;
    }
    box = moved;
    last = grey;
    Sighting seen = sighting(moved & picture, grey.size());
    seen.by_flow = true;
    return seen;
}

Sighting ObjectEye::Insides::sighting(const cv::Rect& seen, const cv::Size& size) const {
    const double focus = size.width / 2.0 / trig::tan(kCameraFieldDeg / 2 * trig::kDegree);
    const auto angle = [&](double column) {
        return trig::atan2(size.width / 2.0 - column, focus) / trig::kDegree;
    };
    Sighting told;
    told.angle_deg = angle(middle(seen).x);
    told.width_deg = angle(seen.x) - angle(seen.x + seen.width);
    told.whole = seen.x > 0 && seen.x + seen.width < size.width;
    const int foot = seen.y + seen.height;
    const double below = foot - size.height / 2.0;
    if (foot < size.height && below > 0) {
        const double depth = kCameraEyeCm * focus / below;
        told.distance_cm = depth / trig::cos(told.angle_deg * trig::kDegree);
    }
    return told;
}

void ObjectEye::Insides::forget() {
    box.reset();
    points.clear();
    without_colour = 0;
}

namespace {

struct Looked {
    cv::Mat picture;
    cv::Mat grey;
};

// Copies: the image may be gone before the next one comes.
Looked look_at(const Image& image) {
    const cv::Mat borrowed(image.height, image.width, CV_8UC3,
                           const_cast<uint8_t*>(image.rgb.data()));
    Looked looked{borrowed.clone(), {}};
    cv::cvtColor(looked.picture, looked.grey, cv::COLOR_RGB2GRAY);
    return looked;
}

}  // namespace

std::optional<Sighting> ObjectEye::find(const Image& image) {
    insides_->forget();
    return follow(image);
}

std::optional<Sighting> ObjectEye::follow(const Image& image) {
    if (!is_usable(image)) return std::nullopt;
    Insides& in = *insides_;
    const auto [picture, grey] = look_at(image);
    const cv::Mat mask = in.mask_of(picture);
    const std::vector<Blob> blobs = in.blobs_in(mask);
    if (!in.box) {
        if (blobs.empty()) return std::nullopt;
        return in.keep(mask, grey, blobs.front());
    }
    // The one nearest to where the flow has carried it.
    const std::optional<cv::Point2d> shift = in.flow_to(grey);
    const cv::Point2d expected = middle(*in.box) + shift.value_or(cv::Point2d());
    const auto distance = [&expected](const Blob& blob) {
        return trig::hypot(middle(blob.box).x - expected.x, middle(blob.box).y - expected.y);
    };
    const auto nearest =
        std::min_element(blobs.begin(), blobs.end(),
                         [&](const Blob& a, const Blob& b) { return distance(a) < distance(b); });
    const double jump = std::max(kJumpMin, static_cast<double>(in.box->width));
    if (nearest != blobs.end() && distance(*nearest) <= jump) return in.keep(mask, grey, *nearest);
    if (shift) return in.keep_by_flow(grey, *shift);
    in.forget();
    return std::nullopt;
}

}  // namespace vagus::toolbox::carbot
