// SPDX-License-Identifier: Apache-2.0
#include "vdbounce/io/png_heights.h"

#include "vdbounce/base/error.h"
#include "vdbounce/base/parallel.h"
#include "vdbounce/io/file_bytes.h"

#include <algorithm>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <png.h>

// libpng leaves by longjmp where a file is damaged, which passes over destructors: what it may leave, the functions
// below that call setjmp and those that libpng calls back, hold plain data only.

namespace vdbounce {
namespace {

constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kMessageBytes = 100;
// Deflate makes at most 1032 bytes of one (zlib's technical details).
constexpr std::size_t kLargestExpansion = 1032;
constexpr std::size_t kRowsPerBlock = 16; // some ten thousand pixels: enough to hide the cost of a task

// Rec. 709, of the values as stored.
constexpr double kRed = 0.2126;
constexpr double kGreen = 0.7152;
constexpr double kBlue = 0.0722;

struct PngState {
    png_structp png = nullptr;
    png_infop info = nullptr;
    const char* bytes = nullptr;
    std::size_t left = 0;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::size_t rowBytes = 0;
    int channels = 0;
    int bytesPerChannel = 0;
    char message[kMessageBytes] = "";
};

void onError(png_structp png, png_const_charp message)
{
    auto* state = static_cast<PngState*>(png_get_error_ptr(png));
    std::strncpy(state->message, message, kMessageBytes - 1);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {} // about what says nothing of the pixels

void readBytes(png_structp png, png_bytep out, std::size_t count)
{
    auto* state = static_cast<PngState*>(png_get_io_ptr(png));
    if (count > state->left) png_error(png, "it ends too early");
    std::memcpy(out, state->bytes, count);
    state->bytes += count;
    state->left -= count;
}

// Reads up to the pixels, and asks for them as 1 to 4 channels of 8 or 16 bits; false where the file is damaged.
bool readHeader(PngState& state)
{
    state.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, onError, onWarning);
    if (state.png == nullptr) return false;
    if (setjmp(png_jmpbuf(state.png)) != 0) return false;
    state.info = png_create_info_struct(state.png);
    if (state.info == nullptr) return false;
    png_set_read_fn(state.png, &state, readBytes);
    png_read_info(state.png, state.info);
    const int color = png_get_color_type(state.png, state.info);
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(state.png);
    if (color == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(state.png, state.info) < 8) {
        png_set_expand_gray_1_2_4_to_8(state.png);
    }
    png_set_interlace_handling(state.png);
    png_read_update_info(state.png, state.info);
    state.columns = png_get_image_width(state.png, state.info);
    state.rows = png_get_image_height(state.png, state.info);
    state.rowBytes = png_get_rowbytes(state.png, state.info);
    state.channels = png_get_channels(state.png, state.info);
    state.bytesPerChannel = png_get_bit_depth(state.png, state.info) / 8;
    return true;
}

bool readRows(PngState& state, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(state.png)) != 0) return false;
    png_read_image(state.png, rows);
    png_read_end(state.png, nullptr);
    return true;
}

class PngReader {
public:
    explicit PngReader(const std::string& path) : path_(path), file_(path)
    {
        const std::string_view bytes = file_.view();
        state_.bytes = bytes.data();
        state_.left = bytes.size();
        const auto* signature = reinterpret_cast<png_const_bytep>(bytes.data());
        if (bytes.size() < kSignatureBytes || png_sig_cmp(signature, 0, kSignatureBytes) != 0) {
            throw InputError(path_, "is no PNG file", "name one, or a .csv or .txt of numbers");
        }
    }
    ~PngReader() { png_destroy_read_struct(&state_.png, &state_.info, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;

    HeightMap read()
    {
        if (!readHeader(state_)) fail();
        if (state_.rows > file_.view().size() * kLargestExpansion / state_.rowBytes) {
            std::strncpy(state_.message, "it is too short for the size that it states", kMessageBytes - 1);
            fail();
        }
        std::vector<png_byte> pixels(state_.rows * state_.rowBytes);
        std::vector<png_bytep> rows(state_.rows);
        for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = pixels.data() + row * state_.rowBytes;
        if (!readRows(state_, rows.data())) fail();
        return toHeights(rows);
    }

private:
    [[noreturn]] void fail() const
    {
        throw InputError(path_, std::string("is a damaged PNG file (") + state_.message + ")", "export it again");
    }

    HeightMap toHeights(const std::vector<png_bytep>& rows) const
    {
        HeightMap map;
        map.columns = static_cast<int>(state_.columns); // libpng refuses more than a million
        map.rows = static_cast<int>(state_.rows);
        map.values.resize(state_.columns * state_.rows);
        forEachIndex(state_.rows, kRowsPerBlock, [&](std::size_t row) {
            double* values = map.values.data() + row * state_.columns;
            if (state_.bytesPerChannel == 1) {
                for (std::size_t i = 0; i < state_.columns; ++i) values[i] = grey<1>(rows[row], i);
            } else {
                for (std::size_t i = 0; i < state_.columns; ++i) values[i] = grey<2>(rows[row], i);
            }
        });
        return map;
    }

    template <int Bytes> double grey(const png_byte* row, std::size_t column) const
    {
        const png_byte* pixel = row + column * std::size_t(state_.channels) * Bytes;
        const double first = channel<Bytes>(pixel, 0);
        if (state_.channels < 3) return first; // grey, or grey and alpha
        const double second = channel<Bytes>(pixel, 1);
        const double third = channel<Bytes>(pixel, 2);
        // A grey that was stored as a colour keeps its bits.
        if (first == second && second == third) return first;
        return kRed * first + kGreen * second + kBlue * third;
    }

    template <int Bytes> static double channel(const png_byte* pixel, int which)
    {
        if (Bytes == 1) return pixel[which] / 255.0;
        return (pixel[2 * which] * 256 + pixel[2 * which + 1]) / 65535.0;
    }

    std::string path_;
    FileBytes file_;
    PngState state_;
};

} // namespace

HeightMap readPngHeights(const std::string& path) { return PngReader(path).read(); }

} // namespace vdbounce
