// glTF and GLB: what the specification says of nodes, modes, accessors and compression.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <glm/geometric.hpp>

#include "tests/tools/mesh_gltf_maker.h"

namespace overlook::mesh::test {
namespace {

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};

std::string one_primitive(const std::string& primitive, const std::string& node = "") {
    return fmt::format(R"("meshes":[{{"primitives":[{{{}}}]}}],"nodes":[{{"mesh":0{}}}],"scenes":[{{"nodes":[0]}}])", primitive,
                       node);
}

std::string square_glb(const std::string& node = "") {
    GltfMaker maker;
    const int positions = maker.floats(kSquare, "VEC3", 3),
              normals = maker.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3),
              indices = maker.indices({0, 1, 2, 0, 2, 3});
    return maker.glb(one_primitive(
        fmt::format(R"("attributes":{{"POSITION":{},"NORMAL":{}}},"indices":{})", positions, normals, indices), node));
}

// With the axes of the file.
MeshFile open_as_it_stands(const std::string& path) {
    Options options;
    options.up = Up::z;
    return open_whole(path, options);
}

glm::dvec3 normal_of(const Mesh& mesh, size_t face) {
    const glm::dvec3 a(corner_m(mesh, face, 0)), b(corner_m(mesh, face, 1)), c(corner_m(mesh, face, 2));
    return glm::normalize(glm::cross(b - a, c - a));
}

TEST(GltfMesh, NodesPlaceMirrorAndTurnWithNormals) {
    const ScratchFolder folder;
    const MeshFile plain = open_as_it_stands(write_file(folder, "a.glb", square_glb()));
    EXPECT_EQ(plain.report.face_count, 2u);
    EXPECT_EQ(normal_of(plain.mesh, 0), glm::dvec3(0, 0, 1));

    const MeshFile mirrored =
        open_as_it_stands(write_file(folder, "b.glb", square_glb(R"(,"scale":[-2,1,1],"translation":[0,0,5])")));
    EXPECT_EQ(area_of(mirrored.mesh), 2);
    EXPECT_EQ(normal_of(mirrored.mesh, 0), glm::dvec3(0, 0, 1));  // still seen from the front
    EXPECT_EQ(mirrored.mesh.normals[0], glm::vec3(0, 0, 1));
    EXPECT_EQ(corner_m(mirrored.mesh, 0, 0).z, 5);

    const MeshFile turned =
        open_as_it_stands(write_file(folder, "c.glb", square_glb(R"(,"matrix":[1,0,0,0, 0,0,1,0, 0,-1,0,0, 0,0,0,1])")));
    EXPECT_EQ(normal_of(turned.mesh, 0), glm::dvec3(0, -1, 0));
    EXPECT_EQ(turned.mesh.normals[0], glm::vec3(0, -1, 0));
}

TEST(GltfMesh, StandsWithYUpUnlessToldOtherwise) {
    const ScratchFolder folder;
    const std::string path = write_file(folder, "a.glb", square_glb(R"(,"translation":[0,0,5])"));
    const MeshFile lies = open_as_it_stands(path);
    Options options;
    for (Up up : {Up::automatic, Up::y}) {
        options.up = up;
        const MeshFile stands = open_whole(path, options);
        EXPECT_EQ(normal_of(stands.mesh, 0), glm::dvec3(0, -1, 0));
        EXPECT_EQ(stands.mesh.normals[0], glm::vec3(0, -1, 0));
        for (size_t c = 0; c < 3; ++c) {
            const auto file = corner_m(lies.mesh, 0, c);
            EXPECT_EQ(corner_m(stands.mesh, 0, c), decltype(file)(file.x, -file.z, file.y));
        }
    }
}

TEST(GltfMesh, ChildrenAreInTheirParentsFrameAndLoopsAreRefused) {
    const ScratchFolder folder;
    GltfMaker maker;
    const int positions = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    const std::string meshes = fmt::format(R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":{}}}}}]}}],)", positions);
    const MeshFile mesh = open_as_it_stands(write_file(
        folder, "a.glb",
        maker.glb(meshes +
                  R"("nodes":[{"children":[1],"scale":[2,2,2]},{"mesh":0,"translation":[1,0,0]}],"scenes":[{"nodes":[0]}])")));
    EXPECT_EQ(corner_m(mesh.mesh, 0, 0), glm::vec3(2, 0, 0));
    EXPECT_EQ(corner_m(mesh.mesh, 0, 1), glm::vec3(4, 0, 0));
    expect_refused(
        write_file(folder, "b.glb",
                   maker.glb(meshes + R"("nodes":[{"children":[1]},{"mesh":0,"children":[0]}],"scenes":[{"nodes":[0]}])")),
        Exit::bad_input, "node 0 has two parents, or is its own ancestor");
}

TEST(GltfMesh, StripsAndFansAreWoundAlikeAndListsNeedNoIndices) {
    const ScratchFolder folder;
    GltfMaker maker;
    const int positions = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3", 3);
    const int fan = maker.indices({0, 1, 3, 4, 2}), glued = maker.indices({0, 1, 2, 2, 3, 4});
    const struct {
        std::string extra;
        uint64_t faces, glue;
    } cases[] = {{R"(,"mode":5)", 3, 0},
                 {fmt::format(R"(,"mode":6,"indices":{})", fan), 3, 0},
                 {fmt::format(R"(,"mode":5,"indices":{})", glued), 2, 2},
                 {R"(,"mode":4)", 1, 0}};
    for (const auto& c : cases) {
        const MeshFile mesh = open_as_it_stands(write_file(
            folder, "a.glb", maker.glb(one_primitive(fmt::format(R"("attributes":{{"POSITION":{}}}{})", positions, c.extra)))));
        EXPECT_EQ(mesh.report.triangle_count, c.faces) << c.extra;
        EXPECT_EQ(mesh.report.strip_glue_count, c.glue) << c.extra;
        EXPECT_EQ(mesh.report.flipped_face_count, 0u);
    }
    expect_refused(write_file(folder, "b.glb",
                              maker.glb(one_primitive(fmt::format(R"("attributes":{{"POSITION":{}}},"mode":1)", positions)))),
                   Exit::bad_input, "has no faces, only points or lines");
}

TEST(GltfMesh, SparseAndQuantizedAccessorsGiveTheirValues) {
    const ScratchFolder folder;
    GltfMaker maker;
    std::string shorts;
    for (const int v : {0, 0, 0, 0, 32767, 0, 0, 0, 0, 16384, 0, 0}) shorts += bytes_of(int16_t(v));
    const int where = maker.view(bytes_of(uint16_t(2))),
              what = maker.view(bytes_of(int16_t(0)) + bytes_of(int16_t(-32768)) + bytes_of(int16_t(0)));
    const int positions = maker.accessor(
        maker.view(shorts, R"(,"byteStride":8)"), 5122, "VEC3", 3,
        fmt::format(
            R"(,"normalized":true,"sparse":{{"count":1,"indices":{{"bufferView":{},"componentType":5123}},"values":{{"bufferView":{}}}}})",
            where, what));
    const MeshFile mesh =
        open_as_it_stands(write_file(folder, "a.glb",
                                     maker.glb(R"("extensionsRequired":["KHR_mesh_quantization"],)" +
                                               one_primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", positions)))));
    ASSERT_EQ(mesh.mesh.faces.size(), 1u);
    EXPECT_EQ(corner_m(mesh.mesh, 0, 1), glm::vec3(1, 0, 0));
    EXPECT_EQ(corner_m(mesh.mesh, 0, 2), glm::vec3(0, -1, 0));
}

TEST(GltfMesh, TextureSetTransformImageAndMaterialAreKept) {
    const ScratchFolder folder;
    GltfMaker maker;
    const int positions = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3),
              set0 = maker.floats({9, 9, 9, 9, 9, 9}, "VEC2", 2), set1 = maker.floats({0, 0, 1, 0, 0, 1}, "VEC2", 2),
              image = maker.view("PNG bytes");
    const std::string rest = fmt::format(
        R"("images":[{{"bufferView":{},"mimeType":"image/png"}}],"textures":[{{"source":0}}],)"
        R"("materials":[{{"name":"brick","alphaMode":"MASK","alphaCutoff":0.25,"doubleSided":true,"pbrMetallicRoughness":)"
        R"({{"baseColorFactor":[1,0.5,0,1],"roughnessFactor":0.25,"metallicFactor":0.5,"baseColorTexture":{{"index":0,"texCoord":0,"extensions":)"
        R"({{"KHR_texture_transform":{{"offset":[0.5,0],"scale":[2,3],"texCoord":1}}}}}}}}}}],)",
        image);
    const MeshFile mesh = open_as_it_stands(write_file(
        folder, "a.glb",
        maker.glb(rest +
                  one_primitive(fmt::format(R"("attributes":{{"POSITION":{},"TEXCOORD_0":{},"TEXCOORD_1":{}}},"material":0)",
                                            positions, set0, set1)))));
    const Surface& surface = mesh.mesh.surfaces[0];
    EXPECT_EQ(surface.name, "brick");
    EXPECT_NEAR(surface.base_colour.g, 0.7354, 1e-4);  // half of the light
    EXPECT_EQ(glm::vec4(surface.base_colour.r, 0, surface.base_colour.b, surface.base_colour.a), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(surface.roughness, 0.25f);
    EXPECT_EQ(surface.metallic, 0.5f);
    EXPECT_EQ(surface.texture, "image-0.png");
    EXPECT_EQ(std::string(surface.texture_bytes.begin(), surface.texture_bytes.end()), "PNG bytes");
    EXPECT_TRUE(surface.is_alpha_masked && surface.is_two_sided);
    EXPECT_EQ(surface.alpha_cutoff, 0.25f);
    EXPECT_EQ(mesh.mesh.uvs[mesh.mesh.face_uvs[0][1]], glm::vec2(2.5f, 0));
    EXPECT_EQ(mesh.mesh.uvs[mesh.mesh.face_uvs[0][2]], glm::vec2(0.5f, 3));
    EXPECT_EQ(mesh.mesh.uvs2, (std::vector<glm::vec2>{{9, 9}}));
}

TEST(GltfMesh, ColoursAreLightInTheFileAndEncodedHere) {
    const ScratchFolder folder;
    GltfMaker maker;
    const int positions = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3),
              colours = maker.floats({0, 0.5f, 1, 0.5f, 2, -1, 0.25f, 1, 0.0021f, 0.5f, 0.5f, 0}, "VEC4", 4);
    const MeshFile mesh = open_as_it_stands(
        write_file(folder, "a.glb",
                   maker.glb(one_primitive(fmt::format(R"("attributes":{{"POSITION":{},"COLOR_0":{}}})", positions, colours)))));
    ASSERT_EQ(mesh.mesh.face_colours.size(), 1u);
    auto colour = [&](size_t corner) { return mesh.mesh.colours[mesh.mesh.face_colours[0][corner]]; };
    using Bytes4 = std::array<uint8_t, 4>;
    EXPECT_EQ(colour(0), (Bytes4{0, 188, 255, 128}));
    EXPECT_EQ(colour(1), (Bytes4{255, 0, 137, 255}));
    EXPECT_EQ(colour(2), (Bytes4{7, 188, 188, 0}));
}

TEST(GltfMesh, BuffersMayLieBesideOrInADataUri) {
    const ScratchFolder folder;
    GltfMaker maker;
    const int positions = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    const std::string rest = one_primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", positions));
    write_file(folder, "my buffer.bin", maker.binary());
    const MeshFile beside = open_as_it_stands(write_file(folder, "a.gltf", maker.json(rest, "my%20buffer.bin")));
    const MeshFile inside = open_as_it_stands(
        write_file(folder, "b.gltf",
                   maker.json(rest, "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA")));
    EXPECT_EQ(beside.mesh.positions_m, inside.mesh.positions_m);
    EXPECT_EQ(inside.report.form, "glTF");
    expect_refused(write_file(folder, "c.gltf", maker.json(rest, "data:;base64,????")), Exit::bad_input,
                   "data URI of buffer 0 is broken");
}

TEST(GltfMesh, MeshoptCompressionGivesTheSameMesh) {
    const ScratchFolder folder;
    std::vector<unsigned char> vertices(meshopt_encodeVertexBufferBound(4, 12)), faces(meshopt_encodeIndexBufferBound(6, 4));
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), kSquare.data(), 4, 12));
    faces.resize(meshopt_encodeIndexBuffer(faces.data(), faces.size(), indices, 6));
    GltfMaker maker;
    const int stored[] = {maker.view(std::string(vertices.begin(), vertices.end())),
                          maker.view(std::string(faces.begin(), faces.end()))};
    const auto compressed = [&](size_t offset, size_t length, size_t stride, size_t count, const char* mode) {
        return maker.raw_view(fmt::format(
            R"({{"buffer":1,"byteLength":{},"extensions":{{"EXT_meshopt_compression":{{"buffer":0,"byteOffset":{},"byteLength":{},"byteStride":{},"count":{},"mode":"{}"}}}}}})",
            stride * count, offset, length, stride, count, mode));
    };
    EXPECT_EQ(stored[1], 1);
    const size_t second = (vertices.size() + 3) / 4 * 4;
    const int positions = maker.accessor(compressed(0, vertices.size(), 12, 4, "ATTRIBUTES"), 5126, "VEC3", 4);
    const int index = maker.accessor(compressed(second, faces.size(), 4, 6, "TRIANGLES"), 5125, "SCALAR", 6);
    const std::string rest = R"("extensionsRequired":["EXT_meshopt_compression"],)" +
                             one_primitive(fmt::format(R"("attributes":{{"POSITION":{}}},"indices":{})", positions, index));
    const std::string fallback = R"(,{"byteLength":72,"extensions":{"EXT_meshopt_compression":{"fallback":true}}})";
    const MeshFile mesh = open_as_it_stands(write_file(folder, "a.glb", maker.glb(rest, fallback)));
    EXPECT_EQ(mesh.report.face_count, 2u);
    EXPECT_EQ(area_of(mesh.mesh), 1);
}

TEST(GltfMesh, DracoCompressionGivesTheSameMesh) {
    const ScratchFolder folder;
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int attribute = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const float* p = kSquare.data();
    builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(0), p, p + 3, p + 6);
    builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(1), p, p + 6, p + 9);
    const std::unique_ptr<draco::Mesh> square = builder.Finalize();
    draco::EncoderBuffer stream;
    ASSERT_TRUE(draco::Encoder().EncodeMeshToBuffer(*square, &stream).ok());
    GltfMaker maker;
    const int view = maker.view(std::string(stream.data(), stream.size())), positions = maker.accessor(-1, 5126, "VEC3", 4),
              indices = maker.accessor(-1, 5125, "SCALAR", 6);
    const auto file = [&](const GltfMaker& made) {
        return made.glb(R"("extensionsRequired":["KHR_draco_mesh_compression"],)" +
                        one_primitive(fmt::format(
                            R"("attributes":{{"POSITION":{}}},"indices":{},"extensions":{{"KHR_draco_mesh_compression":)"
                            R"({{"bufferView":{},"attributes":{{"POSITION":{}}}}}}})",
                            positions, indices, view, square->attribute(attribute)->unique_id())));
    };
    const MeshFile mesh = open_as_it_stands(write_file(folder, "a.glb", file(maker)));
    EXPECT_EQ(mesh.report.face_count, 2u);
    EXPECT_NEAR(area_of(mesh.mesh), 1, 1e-5);
}

TEST(GltfMesh, RefusesEveryTruncation) {
    const ScratchFolder folder;
    const std::string whole = square_glb();
    for (size_t length = 0; length < whole.size(); ++length)
        expect_refused(write_file(folder, "a.glb", whole.substr(0, length)), Exit::bad_input, "");
}

TEST(GltfMesh, NamesThePlaceOfEachMistake) {
    const ScratchFolder folder;
    GltfMaker maker;
    const int positions = maker.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3), bad = maker.indices({0, 1, 7});
    const int too_long = maker.accessor(0, 5126, "VEC3", 4), huge = maker.accessor(0, 5126, "VEC3", size_t(1) << 52);
    const auto with = [&](const std::string& primitive) { return maker.glb(one_primitive(primitive)); };
    const struct {
        std::string bytes;
        const char* words;
    } cases[] = {
        {with(fmt::format(R"("attributes":{{"POSITION":{}}},"indices":{})", positions, bad)),
         "mesh 0, primitive 0: index 2 is 7, there are 3 vertices"},
        {with(fmt::format(R"("attributes":{{"POSITION":{}}})", too_long)), "has 4 elements, but its buffer view holds 3"},
        {with(fmt::format(R"("attributes":{{"POSITION":{}}})", huge)), "elements, but its buffer view holds 3"},
        {with(R"("attributes":{"POSITION":77})"), "/meshes/0/primitives/0/attributes/POSITION: 77 does not exist, there are 4"},
        {maker.glb(R"("extensionsRequired":["KHR_xyz"],)" + one_primitive("")), "needs KHR_xyz, which is not read"},
        {"glTF" + bytes_of(uint32_t(1)) + std::string(20, ' '), "a GLB of version 1"}};
    for (const auto& c : cases) expect_refused(write_file(folder, "a.glb", c.bytes), Exit::bad_input, c.words);
    expect_refused(write_file(folder, "a.gltf", "{\"asset\""), Exit::bad_input, "is not JSON");
    expect_refused(write_file(folder, "a.gltf", std::string(100000, '[')), Exit::bad_input, "is not JSON");
}

}  // namespace
}  // namespace overlook::mesh::test
