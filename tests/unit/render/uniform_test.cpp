// SPDX-License-Identifier: BSD-3-Clause
#include "program_fixture.h"

#include "resource/entry.h"

#include <functional>

namespace terrane {

namespace {

// The vec4 that shows what stands in a column of a value.
std::string shown(const UniformType& type, const std::string& name) {
    const std::string column = type.columns > 1 ? name + "[column]" : name;
    const char* const rest[] = {"", ", 0, 0, 0)", ", 0, 0)", ", 0)", ")"};
    const std::string vector = type.rows > 1 ? "vec" + std::to_string(type.rows) : "float";
    return "vec4(" + vector + "(" + column + ")" + rest[type.rows];
}

double component(const UniformType& type, int index) {
    if (type.kind == UniformKind::boolean) return (index + 1) % 2;
    const bool real = type.kind == UniformKind::float32 || type.kind == UniformKind::float64;
    return index + (real ? 1.5 : 1);
}

template <class T>
T valueOf(const UniformType& type) {
    using Traits = UniformTraits<T>;
    T value{};
    for (int c = 0; c < Traits::columns; ++c) {
        for (int r = 0; r < Traits::rows; ++r)
            Traits::at(value, c, r) =
                static_cast<typename Traits::Scalar>(component(type, c * Traits::rows + r));
    }
    return value;
}

/// How a uniform of type T is declared, and called by GLSL and by us.
struct Form {
    const char* declarations;
    const char* glsl;
    const char* name;
};

// The structures start with 8 bytes, since Mesa 22.3 reads doubles behind a single float wrongly.
const Form kForms[] = {
    {"uniform T u;", "u", "u"},
    {"uniform T u[3];", "(true ? u[2] : u[column])", "u[2]"},
    {"struct S { vec2 a; T m; }; uniform S u;", "u.m", "u.m"},
    {"struct S { vec2 a; T m; }; uniform S u[2];", "u[1].m", "u[1].m"},
    {"uniform B { float a; T u; };", "u", "u"},
    {"layout(row_major) uniform B { float a; T u; };", "u", "u"},
    {"uniform B { float a; T u; } b;", "b.u", "B.u"},
    {"uniform B { float a; T u[2]; };", "u[1]", "u[1]"},
    {"struct S { vec2 a; T m; }; uniform B { S u; };", "u.m", "u.m"},
    {"struct S { vec2 a; T m; }; layout(std140) uniform B { S u[2]; } b;", "b.u[1].m", "B.u[1].m"},
};

std::string withType(std::string text, const std::string& type) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool alone = text[i] == 'T' && (i == 0 || text[i - 1] == ' ');
        if (alone) text.replace(i, 1, type);
    }
    return text;
}

} // namespace

#define FOR_EACH_TYPE(X)                                                                           \
    X(float)                                                                                       \
    X(glm::vec2)                                                                                   \
    X(glm::vec3)                                                                                   \
    X(glm::vec4)                                                                                   \
    X(double)                                                                                      \
    X(glm::dvec2)                                                                                  \
    X(glm::dvec3)                                                                                  \
    X(glm::dvec4)                                                                                  \
    X(int)                                                                                         \
    X(glm::ivec2)                                                                                  \
    X(glm::ivec3)                                                                                  \
    X(glm::ivec4)                                                                                  \
    X(std::uint32_t)                                                                               \
    X(glm::uvec2)                                                                                  \
    X(glm::uvec3)                                                                                  \
    X(glm::uvec4)                                                                                  \
    X(bool)                                                                                        \
    X(glm::bvec2)                                                                                  \
    X(glm::bvec3)                                                                                  \
    X(glm::bvec4)                                                                                  \
    X(glm::mat2)                                                                                   \
    X(glm::mat3)                                                                                   \
    X(glm::mat4)                                                                                   \
    X(glm::mat2x3)                                                                                 \
    X(glm::mat2x4)                                                                                 \
    X(glm::mat3x2)                                                                                 \
    X(glm::mat3x4)                                                                                 \
    X(glm::mat4x2)                                                                                 \
    X(glm::mat4x3)                                                                                 \
    X(glm::dmat2)                                                                                  \
    X(glm::dmat3)                                                                                  \
    X(glm::dmat4)                                                                                  \
    X(glm::dmat2x3)                                                                                \
    X(glm::dmat4x3)

TEST_CASE_FIXTURE(ProgramFixture,
                  "Uniforms of all types are set in the default block and in uniform blocks") {
    const auto check = [&]<class T>(T*) {
        using Traits = UniformTraits<T>;
        const UniformType* const type =
            findUniformType(Traits::kind, Traits::columns, Traits::rows);
        REQUIRE(type);
        const T value = valueOf<T>(*type);
        for (const Form& form : kForms) {
            const std::string declarations =
                withType(form.declarations, std::string(type->name)) + " uniform int column;";
            CAPTURE(declarations);
            const auto program = shows(declarations, shown(*type, form.glsl), 400);
            REQUIRE(program);
            const auto uniform = program->uniform<T>(form.name);
            REQUIRE(uniform.active());
            CHECK(uniform.type() == *type);
            uniform.set(value);
            CHECK(uniform.value().component(type->components() - 1) ==
                  component(*type, type->components() - 1));
            for (int column = 0; column < type->columns; ++column) {
                CAPTURE(column);
                program->find("column").set(column);
                glm::vec4 expected(0);
                for (int row = 0; row < type->rows; ++row)
                    expected[row] = float(component(*type, column * type->rows + row));
                CHECK(draw(*program) == expected);
            }
        }
    };
#define CHECK_TYPE(T) check(static_cast<T*>(nullptr));
    FOR_EACH_TYPE(CHECK_TYPE)
#undef CHECK_TYPE
}

TEST_CASE_FIXTURE(ProgramFixture, "Names of uniforms") {
    const auto program =
        shows("struct D { vec4 offset; float w[2]; }; uniform D deformation; uniform float u[3];\n"
              "uniform Plain { float a; }; uniform Named { float b; float c[2]; } n;\n"
              "uniform Many { float d; } many[2];",
              "deformation.offset + vec4(deformation.w[1] + u[1] + a + n.b + n.c[1] + many[0].d + "
              "many[1].d)");
    REQUIRE(program);
    for (const char* name : {"deformation.offset", "deformation.w[1]", "u[1]", "u", "a", "Plain.a",
                             "Named.b", "b", "Named.c[1]", "c[1]", "Many[0].d", "Many[1].d"}) {
        CAPTURE(name);
        CHECK(program->find(name).active());
    }
    for (const char* name : {"", "x", "u[3]", "u[-1]", "deformation", "Plain.b", "Plain.u[1]",
                             "Named.", "Plain", "u[", "."}) {
        CAPTURE(name);
        CHECK_FALSE(program->find(name).active());
        program->find(name).set(1.0F);
        CHECK(program->find(name).value().type().kind == UniformKind::none);
    }
    program->find("u").set(3.0F);
    CHECK(program->find("u[0]").value().component(0) == 3);
    program->find("Plain.a").set(4.0F);
    CHECK(program->find("a").value().component(0) == 4);
    program->find("Many[1].d").set(5.0F);
    CHECK(program->find("Many[0].d").value().component(0) == 0);
    CHECK(draw(*program) == glm::vec4(9));
    UniformHandle().set(1.0F);
    CHECK_FALSE(UniformHandle().active());
}

TEST_CASE_FIXTURE(ProgramFixture, "Values of another type are refused with one warning") {
    const auto program = shows("uniform vec3 v; uniform int i; uniform B { mat2 m; }; "
                               "uniform sampler2D s;",
                               "vec4(v * float(i) * m[0][0], 1) + texture(s, vec2(0))");
    REQUIRE(program);
    const UniformHandle v = program->find("v");
    v.set(glm::vec3(1, 2, 3));
    SUBCASE("with other components") {
        v.set(glm::vec4(1));
    }
    SUBCASE("with integers") {
        v.set(glm::ivec3(1));
    }
    SUBCASE("with a texture") {
        const Texture texture(*context, {});
        v.set(texture);
    }
    SUBCASE("with another value") {
        v.set(UniformValue(*findUniformType("mat4")));
    }
    SUBCASE("in a block") {
        program->find("m").set(glm::mat3(1));
    }
    SUBCASE("a number for a sampler") {
        program->find("s").set(1);
    }
    SUBCASE("an unsigned number for a signed one") {
        program->find("i").set(1U);
    }
    SUBCASE("a texture of another kind") {
        const Texture texture(*context, {.target = TextureTarget::texture2DArray});
        program->find("s").set(texture);
    }
    CHECK(v.value().component(2) == 3);
    const std::string first = told();
    CHECK(first == "archive.xml:1:1 uniform-type\n");
    v.set(1.0F);
    v.set(1.0F);
    CHECK(diagnostics.all().size() <= 1);
    told();
}

TEST_CASE_FIXTURE(ProgramFixture, "Floats and doubles convert into one another") {
    const auto program = shows("uniform vec2 f; uniform dvec2 d; uniform B { mat2 m; };",
                               "vec4(f, vec2(d)) + vec4(m[0], m[1])", 400);
    REQUIRE(program);
    program->find("f").set(glm::dvec2(1, 2));
    program->find("d").set(glm::vec2(3, 4));
    program->find("m").set(glm::dmat2(10, 20, 30, 40));
    CHECK(draw(*program) == glm::vec4(11, 22, 33, 44));
}

TEST_CASE_FIXTURE(ProgramFixture, "Blocks of the same name, size and members are one") {
    const std::string block = "uniform Globals { vec4 sun; float time; };";
    const auto first = shows(block, "sun");
    const auto second = shows(block, "sun * time");
    const auto other = shows("uniform Globals { vec4 sun; };", "sun");
    const auto renamed = shows("uniform Globals2 { vec4 sun; float time; };", "sun");
    REQUIRE((first && second && other && renamed));
    first->find("sun").set(glm::vec4(1, 2, 3, 4));
    second->find("time").set(2.0F);
    CHECK(draw(*second) == glm::vec4(2, 4, 6, 8));
    CHECK(draw(*first) == glm::vec4(1, 2, 3, 4));
    CHECK(draw(*other) == glm::vec4(0));
    CHECK(draw(*renamed) == glm::vec4(0));
    CHECK(second->find("sun").value().component(3) == 4);
}

TEST_CASE_FIXTURE(ProgramFixture, "Block values are sent together, and only if they differ") {
    UniformBlock block(*context, 64);
    const std::vector<std::byte> ones(64, std::byte{1});
    block.write(0, ones.data(), 4);
    block.write(32, ones.data(), 4);
    block.flush();
    block.flush();
    CHECK(block.uploads() == 1);
    block.write(0, ones.data(), 4);
    block.flush();
    CHECK(block.uploads() == 1);
    block.write(8, ones.data(), 8);
    block.flush();
    CHECK(block.uploads() == 2);
}

TEST_CASE_FIXTURE(ProgramFixture, "Initial values go to uniforms of their name and type") {
    const auto real = [](double x) {
        UniformValue value(*findUniformType("float"));
        value.setComponent(0, x);
        return value;
    };
    const auto module = [&](const std::string& colour, std::vector<InitialUniform> uniforms) {
        ModuleSource m = fragment("struct S { float m; }; uniform S s; uniform float u[2];\n"
                                  "uniform B { float b; float other; }; uniform vec3 v;\n"
                                  "layout(location = 0) out vec4 c;\n"
                                  "void main() { c = vec4(s.m, u[1], b, v.x) * " +
                                  colour + "; }");
        m.uniforms = std::move(uniforms);
        return m;
    };
    const auto archive = file("values.xml", "<uniform1f name='v' x='1'/>");
    const auto program = link(module("1.0", {{"s.m", {}, real(1), {}},
                                             {"u[1]", {}, real(2), {}},
                                             {"B.b", {}, real(3), {}},
                                             {"v", {archive, 11}, real(4), {}},
                                             {"absent", {}, real(5), {}}}));
    REQUIRE(program);
    CHECK(told() == "values.xml:1:12 unmatched-uniform\n");
    CHECK(draw(*program) == glm::vec4(1, 2, 3, 0));

    // The block is there already, so its values are left alone.
    const auto second = link(module("2.0", {{"b", {}, real(9), {}}, {"s.m", {}, real(9), {}}}));
    REQUIRE(second);
    CHECK(draw(*second) == glm::vec4(18, 0, 6, 0));
}

TEST_CASE_FIXTURE(ProgramFixture, "Later modules' initial values win") {
    const auto module = [&](const std::string& text, float x) {
        ModuleSource m = fragment(text);
        UniformValue value(*findUniformType("float"));
        value.setComponent(0, x);
        m.uniforms = {{"u", {}, value, {}}};
        return compile(m);
    };
    const auto program =
        link({module("uniform float u; layout(location = 0) out vec4 c; void main() { c = "
                     "vec4(u); }",
                     1),
              module("float unused() { return 1.0; }", 2)});
    REQUIRE(program);
    CHECK(draw(*program) == glm::vec4(2));
}

TEST_CASE_FIXTURE(ProgramFixture, "Samplers follow the resource that a module names") {
    const auto texture = [&](std::uint8_t red) {
        auto result = std::make_shared<Texture>(
            *context, TextureDescription{.format = InternalFormat::rgba8});
        const std::byte pixel[4] = {std::byte{red}, {}, {}, {}};
        result->upload({TransferFormat::rgba, TransferType::u8}, pixel);
        return result;
    };
    ResourceEntry entry;
    entry.instance = texture(255);
    ModuleSource m = fragment("uniform sampler2D s; layout(location = 0) out vec4 c;\n"
                              "void main() { c = texture(s, vec2(0.5)); }");
    Ref<Texture> ref("grass");
    ref.resolve(&entry);
    m.uniforms = {{.name = "s", .place = {}, .value = {}, .texture = ref}};
    const auto program = link(m);
    REQUIRE(program);
    CHECK(draw(*program).r == 1);
    entry.instance = texture(0);
    CHECK(draw(*program).r == 0);
    program->find("s").set(std::shared_ptr<const Texture>(texture(255)));
    CHECK(draw(*program).r == 1);
}

TEST_CASE_FIXTURE(ProgramFixture, "A sampler without a texture is told once, when drawing") {
    const auto program =
        shows("uniform sampler2D s; uniform sampler3D t; uniform samplerCube u; uniform isampler2D "
              "v; uniform sampler2DShadow w;",
              "texture(s, vec2(0)) + texture(t, vec3(0)) + texture(u, vec3(1)) + vec4(texture(v, "
              "vec2(0))) + texture(w, vec3(0))");
    REQUIRE(program);
    CHECK(told() == "");
    draw(*program);
    CHECK(diagnostics.all().size() == 5);
    const std::string all = told();
    CHECK(all.find("archive.xml:1:1 sampler-unset") == 0);
    CHECK(all.find("gl-error") == std::string::npos);
    draw(*program);
    CHECK(told() == "");
}

TEST_CASE_FIXTURE(ProgramFixture, "Any number of textures share a few units") {
    bindings.emplace(*context, 5, 3);
    std::vector<std::shared_ptr<Texture>> textures;
    for (int i = 0; i < 23; ++i) {
        textures.push_back(std::make_shared<Texture>(
            *context, TextureDescription{.format = InternalFormat::r32f}));
        const auto value = float(i);
        textures.back()->upload({TransferFormat::red, TransferType::f32},
                                std::as_bytes(std::span(&value, 1)));
    }
    std::vector<std::shared_ptr<Program>> programs;
    for (int i = 0; i < 4; ++i)
        programs.push_back(shows("uniform sampler2D s[4]; uniform B" + std::to_string(i) +
                                     " { float b; }; uniform C { float x; };",
                                 "vec4(texture(s[0], vec2(0)).r, texture(s[1], vec2(0)).r, "
                                 "texture(s[2], vec2(0)).r, texture(s[3], vec2(0)).r + b + x)"));
    for (int round = 0; round < 40; ++round) {
        CAPTURE(round);
        Program& program = *programs[round % programs.size()];
        glm::vec4 expected;
        for (int i = 0; i < 4; ++i) {
            const int index = (round * 7 + i * (round % 3)) % 23;
            program.find("s[" + std::to_string(i) + "]")
                .set(std::shared_ptr<const Texture>(textures[index]));
            expected[i] = float(index);
        }
        program.find("b").set(float(round * 100));
        program.find("x").set(float(round * 10000));
        expected.w += float(round * 10100);
        CHECK(draw(program) == expected);
    }
    programs.clear();
}

TEST_CASE("The least recently used unit makes room") {
    UnitTable units(3);
    units.beginDraw();
    const unsigned a = units.unitFor(1, 0), b = units.unitFor(2, 0), c = units.unitFor(3, 0);
    CHECK((a != b && b != c && a != c));
    units.beginDraw();
    CHECK(units.unitFor(1, a) == a);
    CHECK(units.unitFor(3, 99) == c);
    CHECK(units.unitFor(4, 0) == b);
    units.beginDraw();
    CHECK(units.unitFor(2, b) != b); // 4 sits there, used later than...
    CHECK(units.unitFor(4, b) == b);
}

TEST_CASE("Uniform types have names, codes and shapes") {
    CHECK(findUniformType("mat2x3")->columns == 2);
    CHECK(findUniformType("mat2x3")->rows == 3);
    CHECK(findUniformType("isampler2DArray")->isSampler());
    CHECK(findUniformType("float9") == nullptr);
    CHECK(findUniformType(UniformKind::int32, 2, 2) == nullptr);
    CHECK(findUniformType(UniformKind::float64, 3, 3)->name == "dmat3");
    CHECK(uniformType(12345).kind == UniformKind::none);
    UniformValue value(*findUniformType("uint"));
    value.setComponent(0, -5);
    CHECK(value.component(0) == 0);
    value.setComponent(0, 1e30);
    CHECK(value.component(0) == 4294967295.0);
    value.setComponent(0, std::numeric_limits<double>::quiet_NaN());
    CHECK(value.component(0) == 0);
}

} // namespace terrane
