// With libpng's simple interface; nothing of that library shows elsewhere.
#include "sim/png.hpp"

#include <png.h>

#include <cassert>
#include <cstring>

namespace vagus::sim {
namespace {

Error wrong(const std::string& file, const std::string& why) {
    return {Code::BadInput, file + ": is no PNG image that can be used: " + why +
                                "; save it again as a PNG of at most " +
                                std::to_string(kImageSideMax) + " pixels a side"};
}

}  // namespace

Result<Picture> read_png(std::string_view bytes, const std::string& file) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0)
        return wrong(file, image.message);
    if (image.width > kImageSideMax || image.height > kImageSideMax) {
        const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
        png_image_free(&image);
        return wrong(file, "it has " + size + " pixels");
    }
    image.format = PNG_FORMAT_RGB;
    Picture picture{image.width, image.height, std::vector<uint8_t>(PNG_IMAGE_SIZE(image))};
    const png_color white = {255, 255, 255};
    if (png_image_finish_read(&image, &white, picture.pixels.data(), 0, nullptr) == 0)
        return wrong(file, image.message);
    return picture;
}

std::string write_png(const Picture& picture) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.width = picture.width;
    image.height = picture.height;
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string bytes(size, '\0');
    [[maybe_unused]] const int written = png_image_write_to_memory(
        &image, bytes.data(), &size, 0, picture.pixels.data(), 0, nullptr);
    assert(written != 0 && "the picture has as many pixels as it says");
    bytes.resize(size);
    return bytes;
}

}  // namespace vagus::sim
