// Pool arrays: most of a scene file's bytes are lists of numbers, read here character by character.

#include "core/variant/number_scanner.h"
#include "core/variant/numbers.h"
#include "core/variant/value_reader.h"

#include <algorithm>
#include <type_traits>

namespace cl {
namespace {

using Type = Variant::Type;

const char* skip_spaces(const char* p, const char* end) {
    while (p != end && static_cast<unsigned char>(*p) <= 32) {
        p++;
    }
    return p;
}

/// Reads an integer of at most nine digits (it fits 32 bits). nullptr if what starts at `p` is anything else.
const char* scan_small_integer(const char* p, const char* end, int32_t& value) {
    const bool negative = p != end && *p == '-';
    const char* const digits = p + (negative ? 1 : 0);
    const char* const limit = end - digits > 9 ? digits + 9 : end;
    int32_t magnitude = 0;
    for (p = digits; p != limit && *p >= '0' && *p <= '9'; p++) {
        magnitude = magnitude * 10 + (*p - '0');
    }
    const bool ends_here = p != end && (*p == ',' || *p == ' ' || *p == ')');
    if (p == digits || !ends_here) {
        return nullptr;
    }
    value = negative ? -magnitude : magnitude;
    return p;
}

template <typename T>
T element_from_integer(int64_t value) {
    return static_cast<T>(value); // to bytes and ints modulo 2^8 and 2^32, as the format says
}

template <typename T>
T element_from_real(double value) {
    if constexpr (std::is_same_v<T, float>) {
        return static_cast<float>(value);
    } else {
        return static_cast<T>(truncated_to_int32(value));
    }
}

/// Room for as many elements as there can be up to the next ')': the input itself pays for the memory.
template <typename T>
void reserve_elements(std::vector<T>& out, const char* p, const char* end) {
    const char* const close = std::find(p, end, ')');
    out.reserve(static_cast<size_t>(std::count(p, close, ',')) + 1);
}

template <typename T, int kPerElement>
std::vector<T> grouped(const std::vector<float>& numbers) {
    std::vector<T> out(numbers.size() / kPerElement); // an incomplete last group is dropped
    for (size_t i = 0; i < out.size(); i++) {
        const float* n = &numbers[i * kPerElement];
        if constexpr (kPerElement == 2) {
            out[i] = T(n[0], n[1]);
        } else if constexpr (kPerElement == 3) {
            out[i] = T(n[0], n[1], n[2]);
        } else {
            out[i] = T{n[0], n[1], n[2], n[3]};
        }
    }
    return out;
}

} // namespace

/// Reads one number at `p` into `out` and moves `p` behind it; everything that is not plain digits goes the
/// slow way through a token.
template <typename T>
bool ValueReader::read_element(std::string_view name, const char*& p, T& out) {
    const char* const end = tokenizer_.text_end();
    int32_t small = 0;
    if (const char* after = scan_small_integer(p, end, small)) {
        out = element_from_integer<T>(small);
        p = after;
        return true;
    }
    const ScannedNumber number = scan_number(p, end);
    if (number.end != p && number.note == ScannedNumber::Note::None) {
        const bool keep_integer = !number.is_real && !std::is_same_v<T, float>;
        out = keep_integer ? element_from_integer<T>(number.integer) : element_from_real<T>(number.real);
        p = number.end;
        return true;
    }
    tokenizer_.set_position(p);
    double real = 0.0;
    const bool done = read_number(name, real);
    out = element_from_real<T>(real);
    if (done) {
        p = tokenizer_.position();
    }
    return done;
}

template <typename T>
bool ValueReader::read_numbers(std::string_view name, std::vector<T>& out) {
    if (!expect('(', name)) {
        return false;
    }
    const char* const end = tokenizer_.text_end();
    tokenizer_.skip_blank();
    const char* p = tokenizer_.position();
    if (p != end && *p == ')') {
        tokenizer_.set_position(p + 1);
        return true;
    }
    reserve_elements(out, p, end);
    for (;;) {
        if (!read_element(name, p, out.emplace_back())) {
            return false;
        }
        p = skip_spaces(p, end);
        if (p == end || *p != ',') { // the end of the list, a comment or an error
            tokenizer_.set_position(p);
            if (take_if(')')) {
                return true;
            }
            if (!take_if(',')) {
                return fail_expected_in(name, "',' or ')'");
            }
            p = tokenizer_.position();
        } else {
            p++;
        }
        p = skip_spaces(p, end);
    }
}

bool ValueReader::read_strings(std::string_view name, std::vector<std::string>& out) {
    if (!expect('(', name)) {
        return false;
    }
    while (!take_if(')')) {
        if (tokenizer_.peek().kind != TokenKind::String) {
            return fail_expected_in(name, "a string");
        }
        out.push_back(tokenizer_.take().string);
        if (!take_if(',') && !tokenizer_.peek().is(')')) {
            return fail_expected_in(name, "',' or ')'");
        }
    }
    return true;
}

bool ValueReader::read_pool(Variant::Type type, std::string_view name, Variant& out) {
    const auto read_plain = [&]<typename T>(std::vector<T> values) {
        const bool done = read_numbers(name, values);
        out = PoolArray<T>(std::move(values));
        return done;
    };
    std::vector<float> numbers;
    switch (type) {
    case Type::PoolByteArray:
        return read_plain(std::vector<uint8_t>());
    case Type::PoolIntArray:
        return read_plain(std::vector<int32_t>());
    case Type::PoolRealArray:
        return read_plain(std::vector<float>());
    case Type::PoolStringArray: {
        std::vector<std::string> strings;
        const bool done = read_strings(name, strings);
        out = PoolStringArray(std::move(strings));
        return done;
    }
    default:
        break;
    }
    if (!read_numbers(name, numbers)) {
        return false;
    }
    if (type == Type::PoolVector2Array) {
        out = PoolVector2Array(grouped<glm::vec2, 2>(numbers));
    } else if (type == Type::PoolVector3Array) {
        out = PoolVector3Array(grouped<glm::vec3, 3>(numbers));
    } else {
        out = PoolColorArray(grouped<Color, 4>(numbers));
    }
    return true;
}

} // namespace cl
