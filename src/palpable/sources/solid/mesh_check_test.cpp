// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/mesh_check.hpp"

#include <string>
#include <string_view>

#include <gmock/gmock.h>

namespace palpable::sources {
namespace {

using ::testing::HasSubstr;

Result<void> checked(std::string_view text, const std::string& ending) {
  return check_mesh_file(std::as_bytes(std::span(text)), ending);
}

std::string refusal(std::string_view text, const std::string& ending) {
  const auto result = checked(text, ending);
  return result ? "taken" : result.error().message;
}

std::string binary_stl(unsigned stated, std::size_t held) {
  std::string file(84 + 50 * held, '\0');
  file[80] = static_cast<char>(stated);
  return file;
}

constexpr std::string_view kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST(MeshCheck, RefusesABinaryStlThatHoldsMoreOrFewerTrianglesThanItStates) {
  EXPECT_TRUE(checked(binary_stl(12, 12), "stl"));
  EXPECT_THAT(refusal(binary_stl(12, 6), "stl"),
              HasSubstr("it states 12 triangles, which take 684 bytes, and has 384"));
  EXPECT_THAT(refusal(binary_stl(12, 12) + "x", "stl"), HasSubstr("damaged"));
  EXPECT_THAT(refusal(std::string(40, '\0'), "stl"), HasSubstr("header"));
}

TEST(MeshCheck, RefusesATextStlWithoutItsEnd) {
  const std::string body = "solid cone\n" + std::string(kFacet) + std::string(kFacet);
  EXPECT_TRUE(checked(body + "endsolid cone\n", "stl"));
  EXPECT_TRUE(checked(body + "endsolid", "stl"));
  EXPECT_TRUE(checked(body + "endsolid cone\n" + body + "endsolid cone\n", "stl"));
  EXPECT_THAT(refusal(body, "stl"), HasSubstr("after 2 whole triangles its end (endsolid) is missing"));
  EXPECT_THAT(refusal(body.substr(0, body.size() - 20) + "\nendsolid cone\n", "stl"),
              HasSubstr("cut off or damaged"));
}

TEST(MeshCheck, RefusesAnObjWhoseFacesNameVerticesThatThereAreNot) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_TRUE(checked(vertices + "f 1 2 3\n", "obj"));
  EXPECT_TRUE(checked(vertices + "f -3//1 -2//1 -1//1 # all\nf 1/1 2/2 \\\n3/3", "obj"));
  EXPECT_TRUE(checked("f 1 2 3\n" + vertices, "obj")) << "vertices may come later";
  EXPECT_THAT(refusal(vertices + "f 1 2 4\n", "obj"), HasSubstr("the face in line 4 names vertex 4 of 3"));
  EXPECT_THAT(refusal(vertices + "f -1 -2 -4\n", "obj"), HasSubstr("line 4 is not a complete face"));
  EXPECT_THAT(refusal(vertices + "f 1 2", "obj"), HasSubstr("line 4 is not a complete face"));
  EXPECT_THAT(refusal(vertices + "f 0 1 2\n", "obj"), HasSubstr("line 4 is not a complete face"));
  EXPECT_THAT(refusal(vertices + "f 1 two 3\n", "obj"), HasSubstr("line 4 is not a complete face"));
  EXPECT_THAT(refusal(vertices + "v 1 2", "obj"), HasSubstr("line 4 is not a complete vertex"));
  EXPECT_TRUE(checked(vertices + "f 1 2 3", "obj")) << "the last line may have no end";
  EXPECT_THAT(refusal(vertices + "v 1 1 1\nf 1 2 3", "obj"),
              HasSubstr("1 of its 4 vertices belong to no face"));
}

TEST(MeshCheck, RefusesTextWithHoles) {
  using namespace std::string_literals;
  EXPECT_THAT(refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# \0\0\n"s, "obj"), HasSubstr("byte 34 is zero"));
  EXPECT_THAT(refusal("solid a\n" + std::string(kFacet) + "\0endsolid a\n"s, "stl"), HasSubstr("is zero"));
}

TEST(MeshCheck, RefusesAFaceOfMoreCornersThanOneHas) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int k = 0; k < 1024; ++k) text += ' ' + std::to_string(k % 3 + 1);
  EXPECT_TRUE(checked(text + "\n", "obj"));
  EXPECT_THAT(refusal(text + " 1\n", "obj"), HasSubstr("a face of more than 1024 corners, in line 4"));
}

TEST(MeshCheck, RefusesAGlbOfAnotherLengthThanItStates) {
  std::string glb = std::string("glTF\2\0\0\0", 8) + std::string("\x20\0\0\0", 4) + std::string(20, '\0');
  EXPECT_TRUE(checked(glb, "glb"));
  EXPECT_THAT(refusal(glb + "more", "glb"), HasSubstr("it states 32 bytes and has 36"));
  glb.resize(24);
  EXPECT_THAT(refusal(glb, "glb"), HasSubstr("it states 32 bytes and has 24"));
}

}  // namespace
}  // namespace palpable::sources
