// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/diagnostic.h"
#include "resource/value.h"

#include <string>
#include <utility>
#include <vector>

namespace terrane {

struct AttributeDeclaration;

/// What an attribute's text means; decides parsing, schema type and inspector widget.
enum class ValueKind {
    boolean,
    integer,
    real,
    text,
    enumeration,
    integerList,
    realList,
    textList,
    enumerationList,
    reference,
    referenceList,
    target,
    file,
};

/// An attribute as written, entities decoded.
struct AttributeText {
    std::string text;
    Place namePlace;
    Place valuePlace; ///< first character inside the quotes
};

/// The words of an enumeration in the order in which people should read them.
template <class E>
using Words = std::vector<std::pair<std::string, E>>;

/// How one kind of member is read, printed and searched for references. `Context` carries what is
/// known per attribute: the words of an enumeration.
template <class V>
struct ValueTraits;

namespace detail {

struct NoContext {};

/// Follows a value through the text it was read from, which is longer than the value where it holds
/// entities or line breaks of two bytes.
class ValueWalker {
public:
    explicit ValueWalker(Place start)
        : place_(std::move(start)) {}
    void advance(std::size_t bytes); ///< of the value
    const Place& place() const { return place_; }

private:
    Place place_;
};

bool readBool(const AttributeText&, const AttributeDeclaration&, bool&, Diagnostics&);
bool readInt(const AttributeText&, const AttributeDeclaration&, int&, Diagnostics&);
bool readReal(const AttributeText&, const AttributeDeclaration&, double&, Diagnostics&);
bool readIntList(const AttributeText&, const AttributeDeclaration&, std::vector<int>&,
                 Diagnostics&);
bool readRealList(const AttributeText&, const AttributeDeclaration&, std::vector<float>&,
                  Diagnostics&);
bool readTextList(const AttributeText&, const AttributeDeclaration&, std::vector<std::string>&,
                  Diagnostics&);
bool readTarget(const AttributeText&, const AttributeDeclaration&, Target&, Diagnostics&);
bool readReference(const AttributeText&, const AttributeDeclaration&, std::string&, Diagnostics&);
/// The index of the word, or -1 with a diagnostic.
int readWord(const AttributeText&, const AttributeDeclaration&, Diagnostics&);
/// Reads each piece of a comma list as a word.
bool readWords(const AttributeText&, const AttributeDeclaration&, std::vector<int>&, Diagnostics&);

std::string print(bool value);
std::string print(int value);
std::string print(double value);
std::string print(float value);
inline std::string print(const std::string& value) {
    return value;
}
std::string print(const std::vector<int>& value);
std::string print(const std::vector<float>& value);
std::string print(const std::vector<std::string>& value);
std::string print(const Target& value);
inline std::string print(const DataFile& value) {
    return value.name;
}

void referTo(AttributeDeclaration& attribute, std::type_index interface);

template <class T>
void mark(Attr<T>& attr, const AttributeText& text) {
    attr.place = text.valuePlace;
    attr.given = true;
}

template <class T>
void locate(Attr<T>& attr, const Place& place) {
    attr.place = place;
}
inline void locate(RefBase& ref, const Place& place) {
    ref.place = place;
}
template <class T>
void locate(RefList<T>& list, const Place& place) {
    for (Ref<T>& ref : list)
        ref.place = place;
}

/// Traits of an Attr whose reader is a function of the value alone.
template <class T, ValueKind Kind, auto Reader>
struct PlainTraits {
    using Context = NoContext;
    static constexpr ValueKind kind = Kind;
    static void describe(AttributeDeclaration&) {}
    static bool read(const AttributeText& text, const AttributeDeclaration& a, Attr<T>& attr,
                     Context, Diagnostics& diagnostics) {
        mark(attr, text);
        return Reader(text, a, attr.value, diagnostics);
    }
    static std::string print(const Attr<T>& attr, Context) { return detail::print(attr.value); }
    static void collect(Attr<T>&, std::vector<RefBase*>&) {}
};

inline bool readText(const AttributeText& text, const AttributeDeclaration&, std::string& value,
                     Diagnostics&) {
    value = text.text;
    return true;
}
bool readFileName(const AttributeText&, const AttributeDeclaration&, DataFile&, Diagnostics&);
bool readFloat(const AttributeText&, const AttributeDeclaration&, float&, Diagnostics&);

} // namespace detail

template <>
struct ValueTraits<Attr<bool>> : detail::PlainTraits<bool, ValueKind::boolean, detail::readBool> {};
template <>
struct ValueTraits<Attr<int>> : detail::PlainTraits<int, ValueKind::integer, detail::readInt> {};
template <>
struct ValueTraits<Attr<double>> : detail::PlainTraits<double, ValueKind::real, detail::readReal> {
};
template <>
struct ValueTraits<Attr<float>> : detail::PlainTraits<float, ValueKind::real, detail::readFloat> {};
template <>
struct ValueTraits<Attr<std::string>>
    : detail::PlainTraits<std::string, ValueKind::text, detail::readText> {};
template <>
struct ValueTraits<Attr<std::vector<int>>>
    : detail::PlainTraits<std::vector<int>, ValueKind::integerList, detail::readIntList> {};
template <>
struct ValueTraits<Attr<std::vector<float>>>
    : detail::PlainTraits<std::vector<float>, ValueKind::realList, detail::readRealList> {};
template <>
struct ValueTraits<Attr<std::vector<std::string>>>
    : detail::PlainTraits<std::vector<std::string>, ValueKind::textList, detail::readTextList> {};
template <>
struct ValueTraits<Attr<Target>>
    : detail::PlainTraits<Target, ValueKind::target, detail::readTarget> {};
template <>
struct ValueTraits<Attr<DataFile>>
    : detail::PlainTraits<DataFile, ValueKind::file, detail::readFileName> {};

template <class E>
struct ValueTraits<Attr<E>> {
    static_assert(std::is_enum_v<E>, "an attribute of this type can't be declared");
    using Context = Words<E>;
    static constexpr ValueKind kind = ValueKind::enumeration;
    static void describe(AttributeDeclaration&) {}
    static bool read(const AttributeText& text, const AttributeDeclaration& a, Attr<E>& attr,
                     const Words<E>& words, Diagnostics& diagnostics) {
        detail::mark(attr, text);
        const int index = detail::readWord(text, a, diagnostics);
        if (index >= 0) attr.value = words[index].second;
        return index >= 0;
    }
    static std::string print(const Attr<E>& attr, const Words<E>& words) {
        for (const auto& [word, value] : words) {
            if (value == attr.value) return word;
        }
        return {};
    }
    static void collect(Attr<E>&, std::vector<RefBase*>&) {}
};

template <class E>
requires std::is_enum_v<E>
struct ValueTraits<Attr<std::vector<E>>> {
    using Context = Words<E>;
    static constexpr ValueKind kind = ValueKind::enumerationList;
    static void describe(AttributeDeclaration&) {}
    static bool read(const AttributeText& text, const AttributeDeclaration& a,
                     Attr<std::vector<E>>& attr, const Words<E>& words, Diagnostics& diagnostics) {
        detail::mark(attr, text);
        std::vector<int> indices;
        const bool good = detail::readWords(text, a, indices, diagnostics);
        attr.value.clear();
        for (const int index : indices)
            attr.value.push_back(words[index].second);
        return good;
    }
    static std::string print(const Attr<std::vector<E>>& attr, const Words<E>& words) {
        std::string text;
        for (const E& value : attr.value) {
            text += (text.empty() ? "" : ",") + ValueTraits<Attr<E>>::print(value, words);
        }
        return text;
    }
    static void collect(Attr<std::vector<E>>&, std::vector<RefBase*>&) {}
};

template <class T>
struct ValueTraits<Ref<T>> {
    using Context = detail::NoContext;
    static constexpr ValueKind kind = ValueKind::reference;
    static void describe(AttributeDeclaration& a) { detail::referTo(a, typeid(T)); }
    static bool read(const AttributeText& text, const AttributeDeclaration& a, Ref<T>& ref, Context,
                     Diagnostics& diagnostics) {
        ref.place = text.valuePlace;
        return detail::readReference(text, a, ref.name, diagnostics);
    }
    static std::string print(const Ref<T>& ref, Context) { return ref.name; }
    static void collect(Ref<T>& ref, std::vector<RefBase*>& references) {
        references.push_back(&ref);
    }
};

template <class T>
struct ValueTraits<RefList<T>> {
    using Context = detail::NoContext;
    static constexpr ValueKind kind = ValueKind::referenceList;
    static void describe(AttributeDeclaration& a) { detail::referTo(a, typeid(T)); }
    static bool read(const AttributeText& text, const AttributeDeclaration& a, RefList<T>& list,
                     Context, Diagnostics& diagnostics) {
        std::vector<std::string> names;
        if (!detail::readTextList(text, a, names, diagnostics)) return false;
        detail::ValueWalker walker(text.valuePlace);
        list.clear();
        for (const std::string& name : names) {
            if (!name.empty()) list.emplace_back(name).place = walker.place();
            walker.advance(name.size() + 1);
        }
        return true;
    }
    static std::string print(const RefList<T>& list, Context) {
        std::string text;
        for (const Ref<T>& ref : list)
            text += (text.empty() ? "" : ",") + ref.name;
        return text;
    }
    static void collect(RefList<T>& list, std::vector<RefBase*>& references) {
        for (Ref<T>& ref : list)
            references.push_back(&ref);
    }
};

} // namespace terrane
