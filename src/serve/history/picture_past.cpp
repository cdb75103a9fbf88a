#include "serve/history/picture_past.hpp"

#include <algorithm>
#include <utility>

namespace vagus::serve {

void PicturePast::add(KeptPicture picture) {
    if (!pictures_.empty()) picture.t = std::max(picture.t, pictures_.back().t);
    bytes_ += picture.bytes.size();
    pictures_.push_back(std::move(picture));
    const double from = pictures_.back().t - kPastPictureSeconds;
    while (pictures_.front().t < from) {
        bytes_ -= pictures_.front().bytes.size();
        pictures_.pop_front();
    }
    while (bytes_ > kPastPictureBytes && pictures_.size() > 1) thin();
}

// The first of them always goes, so that something does.
void PicturePast::thin() {
    const size_t half = (pictures_.size() + 1) / 2;
    std::deque<KeptPicture> kept;
    for (size_t i = 0; i < pictures_.size(); ++i) {
        if (i < half && i % 2 == 0) {
            bytes_ -= pictures_[i].bytes.size();
        } else {
            kept.push_back(std::move(pictures_[i]));
        }
    }
    pictures_ = std::move(kept);
}

void PicturePast::cut(double t) {
    while (!pictures_.empty() && pictures_.back().t > t) {
        bytes_ -= pictures_.back().bytes.size();
        pictures_.pop_back();
    }
}

const KeptPicture* PicturePast::at(double t, const std::string& robot) const {
    const auto after =
        std::upper_bound(pictures_.begin(), pictures_.end(), t,
                         [](double instant, const KeptPicture& one) { return instant < one.t; });
    const auto is_its = [&robot](const KeptPicture& one) { return one.robot == robot; };
    const auto found = std::find_if(std::make_reverse_iterator(after), pictures_.rend(), is_its);
    return found != pictures_.rend() && found->t >= t - kPictureHolds ? &*found : nullptr;
}

}  // namespace vagus::serve
