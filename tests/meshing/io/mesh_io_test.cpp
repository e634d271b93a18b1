#include "meshing/io/mesh_io.h"

#include "base/error.h"
#include "base/whole_file.h"
#include "tests/support/mesh_shapes.h"
#include "tests/support/temp_dir.h"

#include <cstring>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scree {
namespace {

using meshing::MeshFile;
using meshing::MeshFormat;
using testing::HasSubstr;
using testing::ThrowsMessage;

MeshFile decode(std::string_view text, MeshFormat format, const meshing::MeshLimits& limits = {}) {
    return meshing::decode_mesh({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()},
                                format, "file", limits);
}

MeshFile coloured_sphere() {
    MeshFile file;
    file.mesh = test::icosphere(2, 1.7F);
    for (std::size_t i = 0; i < file.mesh.positions.size(); ++i) {
        file.mesh.positions[i] += glm::vec3(0.1F, 1e-7F, -3e5F);
        file.colours.emplace_back(i % 256, 255 - i % 256, 7 * i % 256);
    }
    return file;
}

class EveryFormat : public testing::TestWithParam<std::tuple<MeshFormat, bool>> {};

TEST_P(EveryFormat, ReadsBackWhatItWrote) {
    const auto [format, text] = GetParam();
    const MeshFile file = coloured_sphere();
    const MeshFile again = decode(meshing::encode_mesh(file, format, {.text = text}), format);
    ASSERT_EQ(again.mesh.triangles.size(), file.mesh.triangles.size());
    if (format == MeshFormat::Stl) {  // numbers its vertices anew
        for (std::size_t t = 0; t < file.mesh.triangles.size(); ++t)
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(again.mesh.positions[again.mesh.triangles[t][k]],
                          file.mesh.positions[file.mesh.triangles[t][k]]);
        return;
    }
    EXPECT_EQ(again.mesh.positions, file.mesh.positions);
    EXPECT_EQ(again.mesh.triangles, file.mesh.triangles);
    if (format == MeshFormat::Ply || format == MeshFormat::Off) {
        EXPECT_EQ(again.colours, file.colours);
    }
}
INSTANTIATE_TEST_SUITE_P(
    Formats, EveryFormat,
    testing::Values(std::tuple(MeshFormat::Obj, true), std::tuple(MeshFormat::Ply, true),
                    std::tuple(MeshFormat::Ply, false), std::tuple(MeshFormat::Off, true),
                    std::tuple(MeshFormat::Stl, true), std::tuple(MeshFormat::Stl, false),
                    std::tuple(MeshFormat::Glb, false)));

TEST_P(EveryFormat, RefusesEveryCutWithAnErrorOrReadsLess) {
    const auto [format, text] = GetParam();
    MeshFile file;
    file.mesh = test::icosphere(0);
    const std::string whole = meshing::encode_mesh(file, format, {.text = text});
    for (std::size_t n = 0; n < whole.size(); n += 1 + whole.size() / 200) {
        try {
            const MeshFile part = decode(whole.substr(0, n), format);
            EXPECT_NO_THROW(meshing::check_mesh(part.mesh));
        } catch (const Error&) {
        }
    }
}

TEST(MeshIo, ReadsFilesByTheirEnding) {
    const test::TempDir folder;
    MeshFile file;
    file.mesh = test::cube(2);
    for (const char* name : {"a.obj", "b.PLY", "c.off", "d.Stl", "e.glb"}) {
        meshing::write_mesh(folder.path() / name, file);
        EXPECT_EQ(meshing::read_mesh(folder.path() / name).mesh.triangles.size(),
                  file.mesh.triangles.size());
    }
    EXPECT_THAT([&] { meshing::read_mesh("x.fbx"); },
                ThrowsMessage<IoError>("cannot tell the format of x.fbx: its name must end in "
                                       ".obj, .ply, .off, .stl or .glb"));
    EXPECT_THROW(meshing::read_mesh(folder.path() / "none.obj"), IoError);
}

TEST(Obj, ReadsWhatOthersWrite) {
    const MeshFile file = decode(
        "# cube\r\nmtllib x.mtl\r\nv 0 0 0 1 0 0\r\nv +1 0 0\r\n"
        "v 1e0 1. 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "g all\nf 1/1/1 2/2/1 3/3/1 4/4/1 # a square\nf -4//1 -2//1 -1//1\n",
        MeshFormat::Obj);
    EXPECT_EQ(file.mesh.positions.size(), 4U);
    EXPECT_THAT(file.mesh.triangles, testing::ElementsAre(glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3),
                                                          glm::uvec3(0, 2, 3)));
    ASSERT_EQ(file.mesh.texcoords.size(), 4U);
    EXPECT_EQ(file.mesh.texcoords[0], glm::vec2(0, 1));
}

TEST(Obj, KeepsTextureCoordinatesOnlyWhereTheyAreOneEach) {
    const MeshFile file = decode(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\n"
        "f 1/1 2/1 3/1\nf 2/2 4/1 3/1\n",
        MeshFormat::Obj);
    EXPECT_TRUE(file.mesh.texcoords.empty());
    EXPECT_EQ(file.mesh.triangles.size(), 2U);
}

TEST(Obj, NamesTheLine) {
    EXPECT_THAT(
        [] { decode("v 0 0 0\nv 1 zero 0\n", MeshFormat::Obj); },
        ThrowsMessage<InvalidInput>("cannot read file: line 2 has no three numbers after 'v'"));
    EXPECT_THAT([] { decode("v 0 0 nan\n", MeshFormat::Obj); },
                ThrowsMessage<InvalidInput>(HasSubstr("no place that floats can hold")));
    EXPECT_THAT([] { decode("v 0 0 0\nf 1 2 0\n", MeshFormat::Obj); },
                ThrowsMessage<InvalidInput>(HasSubstr("line 2 has a face with an index")));
    EXPECT_THAT([] { decode("v 0 0 0\nf 1 2 3\n", MeshFormat::Obj); },
                ThrowsMessage<InvalidInput>(
                    "cannot read file: a face names vertex 2 of 1, counted from 0"));
    EXPECT_THAT([] { decode("", MeshFormat::Obj); },
                ThrowsMessage<InvalidInput>("cannot read file: it holds no vertex"));
}

std::string ply_header(const std::string& format, const std::string& vertices) {
    return "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_index\nend_header\n";
}

TEST(Ply, ReadsBigEndian) {
    std::string bytes = ply_header("binary_big_endian", "3");
    for (const float value : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.5F}) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        for (int shift = 24; shift >= 0; shift -= 8)
            bytes += static_cast<char>(bits >> shift & 0xFFU);
    }
    bytes += '\3';
    for (const char index : {'\0', '\1', '\2'})
        bytes += std::string(3, '\0') + index;
    const MeshFile file = decode(bytes, MeshFormat::Ply);
    EXPECT_EQ(file.mesh.positions[2], glm::vec3(0, 1, 0.5F));
    EXPECT_THAT(file.mesh.triangles, testing::ElementsAre(glm::uvec3(0, 1, 2)));
}

TEST(Ply, PassesOverWhatItDoesNotKnow) {
    const MeshFile file = decode(
        "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar int q\n"
        "element vertex 3\nproperty double z\nproperty uchar mark\n"
        "property float y\nproperty float x\nend_header\n"
        "2 5 5\n3 0 2 1\n6 0 5 4\n9 0 8 7\n",
        MeshFormat::Ply);
    EXPECT_EQ(file.mesh.positions[1], glm::vec3(4, 5, 6));
    EXPECT_TRUE(file.mesh.triangles.empty());
}

TEST(Ply, DoesNotBelieveACount) {
    EXPECT_THAT([] { decode(ply_header("binary_little_endian", "2000000000"), MeshFormat::Ply); },
                ThrowsMessage<InvalidInput>("cannot read file: it declares 2000000000 of 'vertex', "
                                            "more than its bytes can hold"));
    EXPECT_THAT([] { decode(ply_header("ascii", "99999999999"), MeshFormat::Ply); },
                ThrowsMessage<InvalidInput>(HasSubstr("more than its bytes can hold")));
    std::string bytes = ply_header("ascii", "1") + "0 0 0\n4000000000 1 2 3\n";
    EXPECT_THAT([&] { decode(bytes, MeshFormat::Ply); },
                ThrowsMessage<InvalidInput>(HasSubstr("a face declares 4000000000 corners")));
}

TEST(Ply, NamesWhatIsWrong) {
    EXPECT_THAT([] { decode("ply\nformat ascii 1.0\nend_header\n", MeshFormat::Ply); },
                ThrowsMessage<InvalidInput>("cannot read file: it holds no vertex"));
    EXPECT_THAT(
        [] {
            decode(ply_header("ascii", "3") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", MeshFormat::Ply);
        },
        ThrowsMessage<InvalidInput>(HasSubstr("a face names vertex 7 of 3")));
    EXPECT_THAT([] { decode(ply_header("ebcdic", "3"), MeshFormat::Ply); },
                ThrowsMessage<InvalidInput>(HasSubstr("its format 'ebcdic' is not ascii")));
    EXPECT_THAT([] { decode(ply_header("ascii", "1") + "0 0 0\n3 0 -1 0\n", MeshFormat::Ply); },
                ThrowsMessage<InvalidInput>(HasSubstr("it has -1 as an index")));
}

TEST(Off, ReadsCommentsPolygonsAndColours) {
    const MeshFile file = decode(
        "# by hand\nCOFF\n4 1 0 # counts\n0 0 0 1 0 0 1\n1 0 0 0 1 0 1\n"
        "1 1 0 0 0 1 1\n0 1 0 1 1 1 1\n4 0 1 2 3 0.5 0.5 0.5\n",
        MeshFormat::Off);
    EXPECT_EQ(file.mesh.triangles.size(), 2U);
    EXPECT_EQ(file.colours[1], glm::u8vec3(0, 255, 0));
}

TEST(Off, DoesNotBelieveACount) {
    EXPECT_THAT([] { decode("OFF\n900000000 1 0\n0 0 0\n", MeshFormat::Off); },
                ThrowsMessage<InvalidInput>(HasSubstr("it declares 900000000 vertices")));
    EXPECT_THAT([] { decode("OFF\n1 0 0\n0 0\n", MeshFormat::Off); },
                ThrowsMessage<InvalidInput>(HasSubstr("holds no number where one is needed")));
}

TEST(Stl, TellsItsTwoFormsApart) {
    MeshFile file;
    file.mesh = test::icosphere(0);
    std::string bytes = meshing::encode_mesh(file, MeshFormat::Stl);
    bytes.replace(0, 5, "solid");  // some programs do
    EXPECT_EQ(decode(bytes, MeshFormat::Stl).mesh.positions.size(), 12U);
    EXPECT_THAT([&] { decode(bytes.substr(5), MeshFormat::Stl); },
                ThrowsMessage<InvalidInput>(HasSubstr("neither begins with 'solid'")));
    EXPECT_THAT([] { decode("solid\nvertex 0 0 0\nendfacet\n", MeshFormat::Stl); },
                ThrowsMessage<InvalidInput>("cannot read file: line 3 ends a facet of 1 vertices"));
}

TEST(MeshLimits, AreKept) {
    MeshFile file;
    file.mesh = test::icosphere(1);  // 42 vertices, 80 triangles
    for (const MeshFormat format :
         {MeshFormat::Obj, MeshFormat::Ply, MeshFormat::Off, MeshFormat::Stl, MeshFormat::Glb}) {
        const std::string bytes = meshing::encode_mesh(file, format);
        EXPECT_NO_THROW(decode(bytes, format, {.max_vertices = 42, .max_triangles = 80}));
        EXPECT_THROW(decode(bytes, format, {.max_vertices = 41, .max_triangles = 80}),
                     InvalidInput);
        EXPECT_THROW(decode(bytes, format, {.max_vertices = 42, .max_triangles = 79}),
                     InvalidInput);
        EXPECT_THROW(decode(bytes, format, {.max_bytes = 100}), InvalidInput);
    }
}

TEST(MeshIoErrors, NameTheColours) {
    MeshFile file;
    file.mesh = test::icosphere(0);
    file.colours.resize(3);
    EXPECT_THAT([&] { meshing::encode_mesh(file, MeshFormat::Ply); },
                ThrowsMessage<InvalidInput>("the mesh has 12 vertices but 3 colours"));
}

}  // namespace
}  // namespace scree
