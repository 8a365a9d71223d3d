// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/picture/picture.hpp"

#include "palpable/core/files/atomic_file.hpp"
#include "palpable/core/files/byte_reader.hpp"
#include "palpable/sources/picture/exif.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <tiffio.h>

namespace palpable::sources {
namespace {

// OpenCV encodes the test pictures, as an independent implementation; the product decodes without it.

cv::Mat noise(int type, int rows = 37, int columns = 53) {
  cv::Mat m(rows, columns, type);
  cv::RNG random(7);
  if (m.depth() == CV_32F)
    random.fill(m, cv::RNG::UNIFORM, -3.0, 9.0);
  else
    random.fill(m, cv::RNG::UNIFORM, 0, m.depth() == CV_16U ? 65536 : 256);
  return m;
}

std::vector<std::byte> encoded(const std::string& extension, const cv::Mat& m,
                               const std::vector<int>& options = {}) {
  std::vector<unsigned char> bytes;
  EXPECT_TRUE(cv::imencode(extension, m, bytes, options));
  const auto view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

/// OpenCV stores blue first.
double value_of(const cv::Mat& m, int y, int x, int channel) {
  const int c = m.channels() >= 3 && channel < 3 ? 2 - channel : channel;
  const int i = x * m.channels() + c;
  if (m.depth() == CV_8U) return m.ptr<unsigned char>(y)[i] / 255.0;
  if (m.depth() == CV_16U) return m.ptr<std::uint16_t>(y)[i] / 65535.0;
  return m.ptr<float>(y)[i];
}

void expect_same(const Result<Image>& image, const cv::Mat& m, double tolerance = 1e-7) {
  ASSERT_TRUE(image) << image.error().sentence();
  ASSERT_EQ(image->width, m.cols);
  ASSERT_EQ(image->height, m.rows);
  ASSERT_EQ(image->channels, m.channels());
  double worst = 0.0;
  for (int y = 0; y < m.rows; ++y)
    for (int x = 0; x < m.cols; ++x)
      for (int c = 0; c < m.channels(); ++c)
        worst = std::max(worst, std::abs(static_cast<double>(image->pixel(x, y)[c]) - value_of(m, y, x, c)));
  EXPECT_LE(worst, tolerance);
}

TEST(Picture, OfEveryLosslessKindIsReadExactly) {
  const struct {
    const char* extension;
    int type;
    int bits;
  } kCases[] = {
      {".png", CV_8UC1, 8},    {".png", CV_8UC3, 8},    {".png", CV_8UC4, 8},    {".png", CV_16UC1, 16},
      {".png", CV_16UC3, 16},  {".tiff", CV_8UC1, 8},   {".tiff", CV_8UC3, 8},   {".tiff", CV_8UC4, 8},
      {".tiff", CV_16UC1, 16}, {".tiff", CV_16UC3, 16}, {".tiff", CV_32FC1, 32}, {".tiff", CV_32FC3, 32},
      {".bmp", CV_8UC3, 8},    {".pgm", CV_8UC1, 8},    {".pgm", CV_16UC1, 16},  {".ppm", CV_8UC3, 8},
      {".ppm", CV_16UC3, 16},  {".pfm", CV_32FC1, 32},  {".pfm", CV_32FC3, 32}};
  for (const auto& c : kCases) {
    SCOPED_TRACE(std::string(c.extension) + " " + std::to_string(c.type));
    const cv::Mat m = noise(c.type);
    constexpr int kUncompressed = 1;
    const auto image = decode_picture(encoded(c.extension, m, {cv::IMWRITE_TIFF_COMPRESSION, kUncompressed}));
    expect_same(image, m);
    EXPECT_EQ(image->bits, c.bits);
  }
}

TEST(Picture, OfGreyBmpComesAsItsPaletteSays) {
  const cv::Mat m = noise(CV_8UC1);
  const auto image = decode_picture(encoded(".bmp", m));
  ASSERT_TRUE(image);
  EXPECT_EQ(image->channels, 3);
  for (int c = 0; c < 3; ++c)
    EXPECT_FLOAT_EQ(image->pixel(5, 9)[c], static_cast<float>(value_of(m, 9, 5, 0)));
}

TEST(Picture, OfBmpKeepsTheAlphaThatItsMasksName) {
  std::string file("BM\0\0\0\0\0\0\0\0\x46\0\0\0\x38\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\x20\0\x03\0\0\0", 34);
  file += std::string(20, '\0');
  file += std::string("\0\0\xFF\0\0\xFF\0\0\xFF\0\0\0\0\0\0\xFF", 16);
  file += "\x0A\x14\x1E\x80";
  const auto image = decode_picture(as_bytes(file));
  ASSERT_TRUE(image) << image.error().message;
  ASSERT_EQ(image->channels, 4);
  EXPECT_EQ(std::lround(255 * image->pixel(0, 0)[0]), 30);
  EXPECT_EQ(std::lround(255 * image->pixel(0, 0)[3]), 128);
}

TEST(Picture, OfLossyKindsAgreesWithAnotherReader) {
  const cv::Mat m = noise(CV_8UC3);
  const auto jpeg = encoded(".jpg", m);
  const std::vector<unsigned char> raw(reinterpret_cast<const unsigned char*>(jpeg.data()),
                                       reinterpret_cast<const unsigned char*>(jpeg.data()) + jpeg.size());
  expect_same(decode_picture(jpeg), cv::imdecode(raw, cv::IMREAD_UNCHANGED), 2.1 / 255);
  constexpr int kLossless = 101;
  expect_same(decode_picture(encoded(".webp", m, {cv::IMWRITE_WEBP_QUALITY, kLossless})), m);
  expect_same(decode_picture(encoded(".jpg", noise(CV_8UC1), {cv::IMWRITE_JPEG_QUALITY, 100})),
              noise(CV_8UC1), 3.0 / 255);
}

/// A JPEG with an EXIF block that states an orientation, inserted directly after the first marker.
std::vector<std::byte> with_orientation(const std::vector<std::byte>& jpeg, char orientation) {
  std::string block(
      "\xFF\xE1\x00\x22"
      "Exif\0\0"
      "MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0",
      29);
  block += orientation;
  block += std::string(6, '\0');
  block[3] = static_cast<char>(block.size() - 2);
  std::vector<std::byte> out(jpeg.begin(), jpeg.begin() + 2);
  const auto bytes = as_bytes(block);
  out.insert(out.end(), bytes.begin(), bytes.end());
  out.insert(out.end(), jpeg.begin() + 2, jpeg.end());
  return out;
}

TEST(Picture, StandsUprightAsTheCameraNoted) {
  cv::Mat m(24, 40, CV_8UC3);
  for (int y = 0; y < m.rows; ++y)
    for (int x = 0; x < m.cols; ++x)
      m.at<cv::Vec3b>(y, x) = {static_cast<unsigned char>(6 * x), static_cast<unsigned char>(9 * y), 90};
  const auto jpeg = encoded(".jpg", m, {cv::IMWRITE_JPEG_QUALITY, 100});
  for (char orientation = 1; orientation <= 8; ++orientation) {
    SCOPED_TRACE(static_cast<int>(orientation));
    const auto turned = with_orientation(jpeg, orientation);
    ASSERT_EQ(orientation_of(turned), orientation);
    const std::vector<unsigned char> raw(
        reinterpret_cast<const unsigned char*>(turned.data()),
        reinterpret_cast<const unsigned char*>(turned.data()) + turned.size());
    expect_same(decode_picture(turned), cv::imdecode(raw, cv::IMREAD_COLOR), 2.1 / 255);
  }
}

TEST(Picture, OfTruncatedJpegIsAnErrorNotGrey) {
  const auto jpeg = encoded(".jpg", noise(CV_8UC3, 200, 200));
  for (const double part : {0.3, 0.6, 0.9, 0.999}) {
    const auto length = static_cast<std::size_t>(part * static_cast<double>(jpeg.size()));
    const auto image = decode_picture(std::span(jpeg).first(length));
    ASSERT_FALSE(image) << part;
    EXPECT_EQ(image.error().code, ErrorCode::invalid_input);
    EXPECT_NE(image.error().message.find("cut off"), std::string::npos) << image.error().message;
  }
}

TEST(Picture, CutOffAnywhereIsAnErrorInEveryKind) {
  for (const char* extension : {".png", ".jpg", ".tiff", ".bmp", ".webp", ".ppm", ".pfm"}) {
    const auto file =
        encoded(extension, std::strcmp(extension, ".pfm") == 0 ? noise(CV_32FC3) : noise(CV_8UC3));
    for (std::size_t length = 0; length < file.size(); length += 1 + file.size() / 97)
      EXPECT_FALSE(decode_picture(std::span(file).first(length))) << extension << " " << length;
  }
}

TEST(Picture, ThatIsATextFileIsSaidToBeOne) {
  const auto path = std::filesystem::path(testing::TempDir()) / "palpable-text.png";
  ASSERT_TRUE(write_file_atomically(path, as_bytes("This is a shopping list.\n- milk\n")));
  const auto image = read_picture(path);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().sentence(), path.string() + ": is a text file, not a picture");
  EXPECT_EQ(image.error().code, ErrorCode::invalid_input);
}

TEST(Picture, ThatIsMissingIsSaidToBe) {
  const auto image = read_picture("/no/such/picture.png");
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().sentence(), "/no/such/picture.png: cannot be read: No such file or directory");
}

TEST(Picture, OfOnePixelIsRead) {
  for (const char* extension : {".png", ".jpg", ".tiff", ".bmp", ".webp", ".ppm"}) {
    const auto image = decode_picture(encoded(extension, noise(CV_8UC3, 1, 1)));
    ASSERT_TRUE(image) << extension;
    EXPECT_EQ(image->width * image->height, 1);
  }
}

TEST(Picture, OfTwentyThousandSquaredIsRefusedFromItsHeaderAlone) {
  const std::string bmp("BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x20\x4E\0\0\x20\x4E\0\0\x01\0\x18\0\0\0\0\0",
                        34);
  const std::string tga("\0\0\x02\0\0\0\0\0\0\0\0\0\x20\x4E\x20\x4E\x18\0", 18);
  for (const std::string& file : {bmp + std::string(60, '\0'), tga + "x", std::string("P5 20000 20000 255\n"),
                                  std::string("Pf\n20000 20000\n-1\n")}) {
    const auto image = decode_picture(as_bytes(file));
    ASSERT_FALSE(image);
    EXPECT_NE(image.error().message.find("20000 x 20000 pixels are more than the 64 million"),
              std::string::npos)
        << image.error().message;
  }
}

TEST(Tga, IsReadPackedAndPlainFromEveryCorner) {
  const std::string header("\0\0\x02\0\0\0\0\0\0\0\0\0\x02\0\x02\0\x18", 17);
  const std::string pixels("\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0A\x0B\x0C", 12);
  const auto first_red = [&](char descriptor, int x, int y) {
    const auto image = decode_picture(as_bytes(header + descriptor + pixels));
    EXPECT_TRUE(image);
    return std::lround(255 * image->pixel(x, y)[0]);
  };
  EXPECT_EQ(first_red('\x00', 0, 1), 3);
  EXPECT_EQ(first_red('\x10', 1, 1), 3);
  EXPECT_EQ(first_red('\x20', 0, 0), 3);
  EXPECT_EQ(first_red('\x30', 1, 0), 3);

  std::string packed = header;
  packed[2] = '\x0A';
  packed += '\x20';
  packed += std::string("\x82\x01\x02\x03", 4);
  packed += std::string("\x00\x04\x05\x06", 4);
  const auto image = decode_picture(as_bytes(packed));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(std::lround(255 * image->pixel(0, 1)[2]), 1);
  EXPECT_EQ(std::lround(255 * image->pixel(1, 1)[0]), 6);
  EXPECT_FALSE(decode_picture(as_bytes(packed.substr(0, packed.size() - 1))));
}

TEST(Tga, KeepsAlphaAndPalettes) {
  const std::string alpha =
      std::string("\0\0\x02\0\0\0\0\0\0\0\0\0\x01\0\x01\0\x20\x28\x0A\x14\x1E\x80", 18 + 4);
  const auto image = decode_picture(as_bytes(alpha));
  ASSERT_TRUE(image);
  EXPECT_EQ(image->channels, 4);
  EXPECT_EQ(std::lround(255 * image->pixel(0, 0)[3]), 128);
  const std::string palette = std::string("\0\x01\x01\0\0\x02\0\x18\0\0\0\0\x01\0\x01\0\x08\0", 18) +
                              std::string("\x01\x02\x03\x04\x05\x06\x01", 7);
  const auto indexed = decode_picture(as_bytes(palette));
  ASSERT_TRUE(indexed);
  EXPECT_EQ(std::lround(255 * indexed->pixel(0, 0)[0]), 6);
}

struct TiffLayout {
  /// 8 or 16: integers; 32: floats.
  int bits = 8;
  bool tiles = false;
  bool planes_apart = false;
  int channels = 1;
  bool white_is_zero = false;
};

/// Writes the values 0, 1, 2 … (modulo 256 with 8 bits).
std::filesystem::path written_tiff(const TiffLayout& layout) {
  const auto [bits, tiles, apart, channels, white_is_zero] = layout;
  const auto path = std::filesystem::path(testing::TempDir()) / "palpable-layout.tiff";
  constexpr int kWidth = 21;
  constexpr int kHeight = 19;
  TIFF* tiff = TIFFOpen(path.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kWidth);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kHeight);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, channels);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, bits == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  const int grey = white_is_zero ? PHOTOMETRIC_MINISWHITE : PHOTOMETRIC_MINISBLACK;
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, channels == 1 ? grey : PHOTOMETRIC_RGB);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, apart ? PLANARCONFIG_SEPARATE : PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
  const int planes = apart ? channels : 1;
  const int step = apart ? 1 : channels;
  const auto block = [&](int left, int top, int width, int height, int plane) {
    std::vector<std::byte> raw;
    const auto add = [&raw](auto value) {
      const auto bytes = std::as_bytes(std::span(&value, 1));
      raw.insert(raw.end(), bytes.begin(), bytes.end());
    };
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x)
        for (int c = 0; c < step; ++c) {
          const int value = ((y * kWidth + x) * channels) + c + plane;
          if (bits == 32)
            add(static_cast<float>(value));
          else if (bits == 16)
            add(static_cast<std::uint16_t>(value));
          else
            add(static_cast<std::uint8_t>(value));
        }
    const auto row = static_cast<std::uint32_t>(top);
    const auto sample = static_cast<std::uint16_t>(plane);
    if (tiles)
      TIFFWriteTile(tiff, raw.data(), static_cast<std::uint32_t>(left), row, 0, sample);
    else
      TIFFWriteScanline(tiff, raw.data(), row, sample);
  };
  if (tiles) {
    TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 16);
    TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
  }
  for (int plane = 0; plane < planes; ++plane)
    for (int top = 0; top < kHeight; top += tiles ? 16 : 1)
      for (int left = 0; left < kWidth; left += tiles ? 16 : kWidth)
        block(left, top, tiles ? 16 : kWidth, tiles ? 16 : 1, plane);
  TIFFClose(tiff);
  return path;
}

/// Reads the written file and compares every sample.
void expect_tiff_read(const TiffLayout& layout) {
  SCOPED_TRACE(testing::Message() << layout.bits << layout.tiles << layout.channels << layout.planes_apart);
  const auto image = read_picture(written_tiff(layout));
  ASSERT_TRUE(image) << image.error().sentence();
  ASSERT_EQ(image->channels, layout.channels);
  ASSERT_EQ(image->bits, layout.bits);
  const double one = layout.bits == 32 ? 1.0 : layout.bits == 16 ? 65535.0 : 255.0;
  for (std::size_t i = 0; i < image->samples.size(); ++i) {
    const double value = static_cast<double>(layout.bits == 8 ? i % 256 : i) / one;
    ASSERT_FLOAT_EQ(image->samples[i], static_cast<float>(layout.white_is_zero ? 1.0 - value : value)) << i;
  }
}

TEST(Tiff, IsReadInTilesOrRowsWithPlanesApartOrNot) {
  for (const int bits : {8, 16, 32})
    for (const bool tiles : {false, true})
      for (const int channels : {1, 3})
        for (const bool apart : {false, true}) expect_tiff_read({bits, tiles, apart, channels, false});
}

TEST(Tiff, WhoseZeroIsWhiteIsInverted) {
  for (const int bits : {8, 16, 32}) expect_tiff_read({bits, false, false, 1, true});
}

TEST(Picture, SideBySideSplitsIntoItsHalves) {
  const auto image = decode_picture(encoded(".png", noise(CV_8UC3, 10, 21)));
  const auto pair = split_side_by_side(*image);
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->first.width, 10);
  EXPECT_EQ(pair->second.width, 10);
  EXPECT_EQ(pair->first.pixel(3, 4)[1], image->pixel(3, 4)[1]);
  EXPECT_EQ(pair->second.pixel(3, 4)[1], image->pixel(13, 4)[1]);
  const auto stacked = split_over_under(*image);
  EXPECT_EQ(stacked->second.pixel(3, 4)[1], image->pixel(3, 9)[1]);
  EXPECT_FALSE(split_side_by_side(*decode_picture(encoded(".png", noise(CV_8UC3, 10, 1)))));
}

}  // namespace
}  // namespace palpable::sources
