#include <OpenImageIO/imageio.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "tests/cli/check_cut/files.h"

namespace check_cut {
namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

Raster read_hgt(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path + ": cannot be opened");
    std::string bytes{std::istreambuf_iterator<char>(file), {}};
    Raster raster;
    raster.width = raster.height = std::llround(std::sqrt(double(bytes.size()) / 2));
    if (size_t(raster.width * raster.height) * 2 != bytes.size())
        throw std::runtime_error(path + ": is not a square of 16-bit numbers");
    for (size_t i = 0; i < bytes.size(); i += 2) {
        int value = int(uint8_t(bytes[i])) << 8 | int(uint8_t(bytes[i + 1]));
        raster.heights_m.push_back(value >= 32768 ? value - 65536 : value);
    }
    return raster;
}

Raster read_image(const std::string& path) {
    auto input = OIIO::ImageInput::open(path);
    if (!input) throw std::runtime_error(path + ": " + OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    Raster raster;
    raster.width = spec.width, raster.height = spec.height;
    std::vector<float> values(size_t(spec.width) * size_t(spec.height));
    if (spec.format.basetype == OIIO::TypeDesc::FLOAT) {
        if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, values.data()))
            throw std::runtime_error(path + ": " + input->geterror());
        raster.heights_m.assign(values.begin(), values.end());
    } else if (spec.format.basetype == OIIO::TypeDesc::INT16) {
        std::vector<int16_t> whole(values.size());
        if (!input->read_image(0, 0, 0, 1, OIIO::TypeDesc::INT16, whole.data()))
            throw std::runtime_error(path + ": " + input->geterror());
        raster.heights_m.assign(whole.begin(), whole.end());
    } else {
        throw std::runtime_error(path + ": is neither int16 nor float");
    }
    return raster;
}

Raster part_of(const Raster& whole, const Window& window) {
    if (window.width == 0) return whole;
    if (window.x + window.width > whole.width || window.y + window.height > whole.height)
        throw std::runtime_error("the window is beyond the raster");
    Raster part{window.width, window.height, {}};
    for (int64_t y = 0; y < window.height; ++y)
        for (int64_t x = 0; x < window.width; ++x)
            part.heights_m.push_back(whole.heights_m[size_t((window.y + y) * whole.width + window.x + x)]);
    return part;
}

}  // namespace

Raster read_raster(const std::string& path, const Window& window, double nodata) {
    bool is_hgt = path.size() > 4 && path.substr(path.size() - 4) == ".hgt";
    Raster raster = part_of(is_hgt ? read_hgt(path) : read_image(path), window);
    for (double& height_m : raster.heights_m)
        if (float(height_m) == float(nodata)) height_m = kVoid;
    return raster;
}

}  // namespace check_cut
