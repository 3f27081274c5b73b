// IES files: symmetries, types, and what broken ones say.
#include "io/photometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "core/error.h"
#include "io/testing/test_folder.h"

namespace lightsieve {
namespace {

/// A file with these counts, type and numbers.
std::string file(const std::string& counts_and_type, const std::string& numbers,
                 const std::string& multiplier = "1") {
    return "IESNA:LM-63-1995\r\n[TEST] none\r\nTILT=NONE\r\n1 1000 " + multiplier + " " +
           counts_and_type + " 1 0 0 0\r\n1 1 100\r\n" + numbers;
}
Photometry parse(const std::string& text) { return parse_photometry(text, "lamp.ies"); }

/// Type C, by its angles [deg].
float at_c(const Photometry& lamp, float vertical, float horizontal) {
    const float v = deg_to_rad(vertical), h = deg_to_rad(horizontal);
    return lamp.candela({std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), std::cos(v)});
}

TEST(Photometry, OneHorizontalAngleIsRotational) {
    const Photometry lamp = parse(file("3 1 1", "0 45 90\n0\n100 50 10"));
    EXPECT_EQ(lamp.peak(), 100);
    for (const float h : {0.0F, 77.0F, 200.0F, 359.0F}) {
        EXPECT_NEAR(at_c(lamp, 0, h), 100, 1e-3F);
        EXPECT_NEAR(at_c(lamp, 22.5F, h), 75, 1e-3F);
        EXPECT_NEAR(at_c(lamp, 67.5F, h), 30, 1e-3F);
        EXPECT_NEAR(at_c(lamp, 90, h), 10, 1e-2F);
        EXPECT_EQ(at_c(lamp, 91, h), 0) << "not measured: no light";
    }
}

TEST(Photometry, FactorsMultiply) {
    std::string text = file("1 1 1", "0\n0\n100", "2.5");
    text.replace(text.find("\r\n1 1 100"), 9, "\r\n0.5 0.8 100");
    EXPECT_NEAR(parse(text).peak(), 100 * 2.5F * 0.5F * 0.8F, 1e-3F);
}

TEST(Photometry, SymmetriesFoldTheSphere) {
    // One vertical angle, 90: only the horizontal angle matters.
    const Photometry quarter = parse(file("2 3 1", "0 180\n0 45 90\n1 1 2 2 3 3"));
    EXPECT_NEAR(at_c(quarter, 90, 22.5F), 1.5F, 1e-4F);
    for (const float h : {45.0F, 135.0F, 225.0F, 315.0F})
        EXPECT_NEAR(at_c(quarter, 90, h), 2, 1e-4F) << h;
    EXPECT_NEAR(at_c(quarter, 90, 270), 3, 1e-4F);
    EXPECT_NEAR(at_c(quarter, 90, 180), 1, 1e-4F);

    const Photometry half = parse(file("2 3 1", "0 180\n0 90 180\n1 1 2 2 3 3"));
    EXPECT_NEAR(at_c(half, 90, 180), 3, 1e-4F);
    EXPECT_NEAR(at_c(half, 90, 270), 2, 1e-4F);
    EXPECT_NEAR(at_c(half, 90, 315), 1.5F, 1e-4F);

    const Photometry other_half = parse(file("2 3 1", "0 180\n90 180 270\n1 1 2 2 3 3"));
    EXPECT_NEAR(at_c(other_half, 90, 90), 1, 1e-4F);
    EXPECT_NEAR(at_c(other_half, 90, 0), 2, 1e-4F);
    EXPECT_NEAR(at_c(other_half, 90, 315), 2.5F, 1e-4F);

    const Photometry all = parse(file("2 5 1", "0 180\n0 90 180 270 360\n1 1 2 2 3 3 4 4 1 1"));
    EXPECT_NEAR(at_c(all, 90, 225), 3.5F, 1e-4F);
    EXPECT_NEAR(at_c(all, 90, 315), 2.5F, 1e-4F);
    // The same without the angle that closes the circle.
    const Photometry open = parse(file("2 4 1", "0 180\n0 90 180 270\n1 1 2 2 3 3 4 4"));
    EXPECT_NEAR(at_c(open, 90, 315), 2.5F, 1e-4F);
}

TEST(Photometry, TypesBAndA) {
    const auto direction = [](float x, float y, float z) { return normalize(Vec3f{x, y, z}); };
    // Brighter upward (vertical angles -90..90) and to the side (horizontal angles 0..90, mirrored).
    const std::string numbers = "-90 0 90\n0 90\n1 2 3 11 12 13";
    const Photometry b = parse(file("3 2 2", numbers)), a = parse(file("3 2 3", numbers));
    for (const Photometry* lamp : {&a, &b}) {
        EXPECT_NEAR(lamp->candela({0, 0, 1}), 2, 1e-4F);
        EXPECT_NEAR(lamp->candela(direction(0, 1, 1)), 2.5F, 1e-4F);
        EXPECT_NEAR(lamp->candela(direction(0, -1, 1)), 1.5F, 1e-4F);
        for (const float side : {-1.0F, 1.0F})
            EXPECT_NEAR(lamp->candela(direction(side, 0, 1)), 7, 1e-3F);
    }
    // Off both axes they differ: the sine of B's horizontal angle is x, that of A's vertical angle y.
    const Vec3f corner = direction(1, 1, 1);
    const float small = std::asin(std::sqrt(1.0F / 3)) * 180 / kPi;
    EXPECT_NEAR(b.candela(corner), 2.5F + 10 * small / 90, 1e-3F);
    EXPECT_NEAR(a.candela(corner), 2 + small / 90 + 5, 1e-3F);
    EXPECT_EQ(a.candela({0, 0, -1}), 0) << "behind";
}

TEST(Photometry, TiltTablesAndHeadersAreSkipped) {
    const std::string text =
        "any words\n12 34\n[MORE] TILT is below\nTILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.8\n"
        "1,1000,1,1,1,1,1,0,0,0\n+1 1e0 1.0E+2\n0,\n0\n7.5\n\x1a";
    EXPECT_NEAR(parse(text).peak(), 7.5F, 1e-5F);
}

/// What a broken text says.
std::string trouble(const std::string& text) {
    try {
        static_cast<void>(parse(text));
    } catch (const InputError& e) {
        EXPECT_EQ(e.errors().at(0).code, Code::FileFormat);
        return e.errors().at(0).message;
    }
    return "nothing";
}

TEST(Photometry, BrokenFilesSayWhatIsWrong) {
    const auto expect_said = [](const std::string& text, const std::string& part) {
        EXPECT_NE(trouble(text).find(part), std::string::npos) << trouble(text);
    };
    expect_said("", "no line that begins with TILT=");
    expect_said("TILT=NONE", "ends before its number of lamps");
    expect_said("TILT=INCLUDE\n1 99999", "number of tilts");
    expect_said(file("3 1 1", "0 45 90\n0\n100 50"), "ends before its candela values");
    expect_said(file("3 1 1", "0 90 45\n0\n1 2 3"), "vertical angles do not rise");
    expect_said(file("1 2 1", "0\n90 0\n1 2"), "horizontal angles do not rise");
    expect_said(file("3 1 4", "0 45 90\n0\n1 2 3"), "photometric type");
    expect_said(file("0 1 1", "0\n1"), "no angles");
    expect_said(file("-3 1 1", "0"), "number of vertical angles is no sensible number");
    expect_said(file("2000000000 2000000000 1", "0"), "no sensible number");
    expect_said(file("1.5 1 1", "0"), "no sensible number");
    expect_said(file("1 1 1", "nan\n0\n1"), "\"nan\" stands for its vertical angles");
    expect_said(file("1 1 1", "0\n0\n1x"), "\"1x\" stands for its candela values");
    expect_said(file("1 1 1", "0\n0\n1e30", "1e30"), "range of numbers");
    // Negative intensities are none.
    EXPECT_EQ(parse(file("1 1 1", "0\n0\n-5")).peak(), 0);
    // Every prefix of a good file is refused, and none is read beyond its end.
    const std::string good = file("3 2 1", "0 45 90\n0 90\n1 2 3 4 5 600");
    for (std::size_t n = 0; n + 3 < good.size(); ++n)
        EXPECT_NE(trouble(good.substr(0, n)), "nothing") << n;
}

using PhotometryFiles = FolderTest;

TEST_F(PhotometryFiles, ReadAndRefused) {
    std::ofstream(in_folder("good.ies")) << file("1 1 1", "0\n0\n42");
    EXPECT_EQ(read_photometry(in_folder("good.ies")).peak(), 42);
    const auto code = [&](const std::string& path) {
        try {
            static_cast<void>(read_photometry(path));
        } catch (const InputError& e) {
            return e.errors().at(0).code;
        }
        return Code::InvalidValue;
    };
    EXPECT_EQ(code(in_folder("missing.ies")), Code::FileNotFound);
    std::ofstream(in_folder("large.ies")) << std::string(kMaxPhotometryBytes + 1, ' ');
    EXPECT_EQ(code(in_folder("large.ies")), Code::LimitFileSize);
    // A file of no size whose bytes cannot be read.
    EXPECT_EQ(code("/proc/self/mem"), Code::FileFormat);
}

}  // namespace
}  // namespace lightsieve
