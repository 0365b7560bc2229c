// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include <glm/glm.hpp>

namespace terrane {

/// What the components of a uniform are.
enum class UniformKind { none, float32, float64, int32, uint32, boolean, sampler, image };

/// The type of a uniform. Two uniforms are of one type when their codes are equal.
struct UniformType {
    std::string_view name; ///< as GLSL writes it: "mat2x3"
    unsigned code = 0;     ///< OpenGL's own, such as GL_FLOAT_MAT2x3
    UniformKind kind = UniformKind::none;
    int columns = 0; ///< 1 for scalars and vectors
    int rows = 0;    ///< components of a scalar, a vector, or of a column

    int components() const { return columns * rows; }
    bool isSampler() const { return kind == UniformKind::sampler; }
    bool operator==(const UniformType& other) const { return code == other.code; }
};

/// The type with one of OpenGL's codes; of kind `none` when it is unknown.
const UniformType& uniformType(unsigned code);
/// By GLSL's name; null when there is none.
const UniformType* findUniformType(std::string_view name);
/// The scalar, vector or matrix type with these components; null when GLSL has none (matrices of
/// integers).
const UniformType* findUniformType(UniformKind kind, int columns, int rows);

/// A value of any scalar, vector or matrix type: components in column order, 4 bytes each (8 for
/// doubles; booleans are 0 or 1).
class UniformValue {
public:
    static constexpr std::size_t kSize = 16 * sizeof(double);

    UniformValue() = default;
    explicit UniformValue(const UniformType& type)
        : type_(&type) {}

    const UniformType& type() const { return *type_; }
    const std::byte* data() const { return bytes_.data(); }
    std::byte* data() { return bytes_.data(); }
    /// Bytes in use.
    std::size_t size() const { return type_->components() * componentSize(); }
    std::size_t componentSize() const { return type_->kind == UniformKind::float64 ? 8 : 4; }

    /// A component as a number, and from one (converted to the type's kind).
    double component(int index) const;
    void setComponent(int index, double value);

    bool operator==(const UniformValue& other) const;

private:
    const UniformType* type_ = &uniformType(0);
    std::array<std::byte, kSize> bytes_{};
};

/// How C++ types stand for GLSL's: the scalars float, double, int, std::uint32_t and bool, and
/// glm's vectors and matrices of them.
template <class T>
struct UniformTraits;

template <class T>
requires std::is_arithmetic_v<T>
struct UniformTraits<T> {
    static constexpr UniformKind kind = std::is_same_v<T, float>           ? UniformKind::float32
                                        : std::is_same_v<T, double>        ? UniformKind::float64
                                        : std::is_same_v<T, int>           ? UniformKind::int32
                                        : std::is_same_v<T, std::uint32_t> ? UniformKind::uint32
                                        : std::is_same_v<T, bool>          ? UniformKind::boolean
                                                                           : UniformKind::none;
    static_assert(kind != UniformKind::none, "GLSL has no such type");
    static constexpr int columns = 1;
    static constexpr int rows = 1;
    using Scalar = T;
    static const Scalar& at(const T& value, int, int) { return value; }
    static Scalar& at(T& value, int, int) { return value; }
};

template <int N, class S>
struct UniformTraits<glm::vec<N, S>> {
    static constexpr UniformKind kind = UniformTraits<S>::kind;
    static constexpr int columns = 1;
    static constexpr int rows = N;
    using Scalar = S;
    static const Scalar& at(const glm::vec<N, S>& value, int, int row) { return value[row]; }
    static Scalar& at(glm::vec<N, S>& value, int, int row) { return value[row]; }
};

template <int C, int R, class S>
struct UniformTraits<glm::mat<C, R, S>> {
    static constexpr UniformKind kind = UniformTraits<S>::kind;
    static constexpr int columns = C;
    static constexpr int rows = R;
    using Scalar = S;
    static const Scalar& at(const glm::mat<C, R, S>& value, int column, int row) {
        return value[column][row];
    }
    static Scalar& at(glm::mat<C, R, S>& value, int column, int row) { return value[column][row]; }
};

/// Components of C++ values without a type yet, as a uniform takes them.
struct UniformComponents {
    UniformKind kind = UniformKind::none;
    int columns = 0;
    int rows = 0;
    std::array<double, 16> reals{};          ///< of float and double kinds, in column order
    std::array<std::uint32_t, 4> integers{}; ///< of the other kinds, as bits
};

template <class T>
UniformComponents uniformComponents(const T& value) {
    using Traits = UniformTraits<T>;
    UniformComponents result;
    result.kind = Traits::kind;
    result.columns = Traits::columns;
    result.rows = Traits::rows;
    for (int column = 0; column < Traits::columns; ++column) {
        for (int row = 0; row < Traits::rows; ++row) {
            const auto scalar = Traits::at(value, column, row);
            if constexpr (std::is_floating_point_v<typename Traits::Scalar>)
                result.reals[column * Traits::rows + row] = scalar;
            else
                result.integers[row] = static_cast<std::uint32_t>(scalar);
        }
    }
    return result;
}

/// Gives a value of type `type` the components. Floats and doubles convert into one another; all
/// else must match. False, and nothing changed, when it doesn't.
bool assignComponents(const UniformComponents& components, UniformValue& value);

} // namespace terrane
