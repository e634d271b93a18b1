#include "terrain/gpu/shader_program.h"

#include "tests/terrain/gpu/gl_fixture.h"

#include <gmock/gmock.h>

namespace scree::terrain {
namespace {

constexpr const char* kVertex = "#version 450 core\nvoid main() { gl_Position = vec4(0); }\n";

class ShaderPrograms : public test::GlTest {};

TEST_F(ShaderPrograms, ErrorsNameProgramStageAndLine) {
    const std::string broken =
        "#version 450 core\nlayout(local_size_x = 1) in;\nvoid main() { wrong(); }\n";
    EXPECT_THAT(
        [&] {
            ShaderProgram("the test", {{ShaderStage::Compute, broken}});
        },
        testing::ThrowsMessage<DeviceError>(
            testing::AllOf(testing::HasSubstr("compute shader of the test does not compile"),
                           testing::HasSubstr("wrong"),
                           testing::HasSubstr("in line 3: void main() { wrong(); }"))));
}

TEST_F(ShaderPrograms, ErrorsOfLinkingNameTheProgram) {
    const std::string fragment =
        "#version 450 core\nin vec3 missing;\nout vec4 colour;\n"
        "void main() { colour = vec4(missing, 1); }\n";
    EXPECT_THAT(
        [&] {
            ShaderProgram("the pair",
                          {{ShaderStage::Vertex, kVertex}, {ShaderStage::Fragment, fragment}});
        },
        testing::ThrowsMessage<DeviceError>(testing::HasSubstr("shaders of the pair do not link")));
}

}  // namespace
}  // namespace scree::terrain
