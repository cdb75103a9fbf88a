// Pictures of cameras during a run, some of them: they are large. When they are too many, every
// second one of the older half goes, again and again.
//
//     PicturePast pictures;
//     pictures.add({.t = 3, .robot = "carbot", .bytes = bytes});
//     if (const KeptPicture* then = pictures.at(3.4, "carbot")) show(*then);
#pragma once

#include <cstddef>
#include <deque>
#include <string>

namespace vagus::serve {

constexpr size_t kPastPictureBytes = 32u << 20;  // all together
constexpr double kPastPictureSeconds = 3600;     // what is older is dropped
constexpr double kPictureHolds = 5;  // seconds; one that is older is none of that instant

struct KeptPicture {
    double t = 0;
    std::string robot = {};
    std::string bytes = {};  // the payload of the topic picture
};

class PicturePast {
public:
    // In the order of time; one that goes back is taken for the newest instant.
    void add(KeptPicture picture);
    // As if nothing had been told after that instant.
    void cut(double t);
    // The last one of that robot until then. Valid until something is added or cut.
    const KeptPicture* at(double t, const std::string& robot) const;
    size_t bytes() const { return bytes_; }
    size_t count() const { return pictures_.size(); }

private:
    void thin();

    std::deque<KeptPicture> pictures_;
    size_t bytes_ = 0;
};

}  // namespace vagus::serve
