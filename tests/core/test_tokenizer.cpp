#include "core/variant/tokenizer.h"

#include <doctest/doctest.h>

#include <cmath>

namespace cl {
namespace {

/// The descriptions of all tokens, separated by blanks; stops at the first damaged one.
std::string tokens(std::string_view text) {
    Tokenizer tokenizer(text, "", nullptr);
    std::string out;
    for (;;) {
        const Token token = tokenizer.take();
        if (token.kind == TokenKind::Invalid) {
            return out + tokenizer.error().to_string();
        }
        out += token.describe();
        if (token.kind == TokenKind::End) {
            return out;
        }
        out += ' ';
    }
}

std::string first_string(std::string_view text) {
    Tokenizer tokenizer(text, "", nullptr);
    const Token token = tokenizer.take();
    return token.kind == TokenKind::String ? token.string : "not a string: " + tokenizer.error().to_string();
}

std::string place(Tokenizer& tokenizer, size_t offset) {
    const SourceLocation at = tokenizer.location(offset);
    return std::to_string(at.line) + ':' + std::to_string(at.column);
}

} // namespace

TEST_SUITE("core/variant/tokenizer") {
    TEST_CASE("white space is every code up to 32, a comment runs from ';' to the end of its line") {
        CHECK(tokens("a\tb\r\nc\x01"
                     "d") == "'a' 'b' 'c' 'd' end of text");
        CHECK(tokens("a;b c\nd ; e") == "'a' 'd' end of text");
        CHECK(tokens(";only") == "end of text");
        CHECK(tokens("") == "end of text");
        CHECK(tokens(std::string_view("a\0b", 3)) == "'a' 'b' end of text");
    }

    TEST_CASE("punctuation stands alone, identifiers run over letters, digits and underlines") {
        CHECK(tokens("{}[]():,.=") == "'{' '}' '[' ']' '(' ')' ':' ',' '.' '=' end of text");
        CHECK(tokens("_a1=Vector2(b.c)") == "'_a1' '=' 'Vector2' '(' 'b' '.' 'c' ')' end of text");
    }

    TEST_CASE("numbers, colours and signed names are one token each") {
        CHECK(tokens("1 -2 3.5 .5 +4 1E1") ==
              "number 1 number -2 number 3.5 number .5 number +4 number 1E1 end of text");
        CHECK(tokens("#ff80 #fffx #") == "'#ff80' '#fff' 'x' '#' end of text");
        CHECK(tokens("-inf +inf -nan inf -inf.0 -info") ==
              "number -inf number +inf number -nan 'inf' number -inf.0 number - 'info' end of text");
        Tokenizer tokenizer("-inf", "", nullptr);
        CHECK(tokenizer.peek().real == -HUGE_VAL);
    }

    TEST_CASE("characters that start no token are shown, control bytes and damaged UTF-8 as numbers") {
        CHECK(tokens("@") == "'@' end of text");
        CHECK(tokens("\xc3\xa9") == "'\xc3\xa9' end of text");
        CHECK(tokens("\xc3") == "byte 0xc3 end of text");
        CHECK(tokens("\x7f") == "byte 0x7f end of text");
        CHECK(tokens("+.") == "'+' '.' end of text");
    }

    TEST_CASE("strings may hold raw newlines and the escapes b t n f r, any other letter stands for itself") {
        CHECK(first_string("\"a\nb\"") == "a\nb");
        CHECK(first_string(R"("\b\t\n\f\r")") == "\b\t\n\f\r");
        CHECK(first_string(R"("\"\\\/\q\a\v\'")") == "\"\\/qav'");
        CHECK(first_string("\"\"").empty());
        CHECK(first_string("\"; no comment\"") == "; no comment");
    }

    TEST_CASE("unicode escapes give UTF-8, pairs of surrogates one code point, a lone one a replacement") {
        CHECK(first_string(R"("\u0041\u00e9\u20AC1")") == "A\xc3\xa9\xe2\x82\xac"
                                                          "1");
        CHECK(first_string(R"("\ud83d\ude00")") == "\xf0\x9f\x98\x80");
        CHECK(first_string(R"("\ud83dx")") == "\xef\xbf\xbdx");
        CHECK(first_string(R"("\ud83d\u0041")") == "\xef\xbf\xbd"
                                                   "A");
    }

    TEST_CASE("bytes that are not UTF-8 are replaced, with a remark") {
        Diagnostics diagnostics;
        Tokenizer tokenizer("x \"a\xff\"", "f", &diagnostics);
        tokenizer.advance();
        static_cast<void>(tokenizer.take());
        CHECK(tokenizer.take().string == "a\xef\xbf\xbd");
        REQUIRE(diagnostics.warnings().size() == 1);
        CHECK(diagnostics.warnings()[0].to_string() ==
              "f:1:3: warning: expected UTF-8, found other bytes in a string: they are replaced");
    }

    TEST_CASE("damaged strings are reported at their start, damaged escapes where they are") {
        CHECK(tokens("a\n  \"bc") ==
              "'a' 2:3: error: expected a closing '\"' for this string, found end of text");
        CHECK(tokens("\"bc\\") == "1:1: error: expected a closing '\"' for this string, found end of text");
        CHECK(tokens("\"ab\\u12\"") == "1:4: error: expected four hexadecimal digits after \\u in a string");
        CHECK(tokens("\"\\u12") == "1:2: error: expected four hexadecimal digits after \\u in a string");
    }

    TEST_CASE("lines and columns count from 1, columns in code points, in any order of asking") {
        const std::string_view text = "ab\n\xc3\xa9x\n\n\ty";
        Tokenizer tokenizer(text, "f", nullptr);
        CHECK(place(tokenizer, 0) == "1:1");
        CHECK(place(tokenizer, 1) == "1:2");
        CHECK(place(tokenizer, 2) == "1:3");
        CHECK(place(tokenizer, 3) == "2:1");
        CHECK(place(tokenizer, 5) == "2:2"); // one column behind a letter of two bytes
        CHECK(place(tokenizer, 8) == "4:1");
        CHECK(place(tokenizer, text.size()) == "4:3");
        CHECK(place(tokenizer, 1) == "1:2");
        CHECK(tokenizer.location(3).file == "f");
    }

    TEST_CASE("a byte order mark is skipped and counts as no column") {
        Tokenizer tokenizer("\xef\xbb\xbf"
                            "a",
                            "", nullptr);
        CHECK(tokenizer.peek().raw == "a");
        CHECK(place(tokenizer, tokenizer.peek().offset) == "1:1");
    }

    TEST_CASE("only the first error is kept, and only a number of remarks") {
        Diagnostics diagnostics;
        Tokenizer tokenizer("abc", "", &diagnostics);
        CHECK_FALSE(tokenizer.fail(0, "first"));
        CHECK_FALSE(tokenizer.fail(1, "second"));
        CHECK(tokenizer.error().message == "first");
        for (int i = 0; i < 2 * Tokenizer::kMaxRemarks; i++) {
            tokenizer.remark(0, "odd");
        }
        CHECK(diagnostics.warnings().size() == Tokenizer::kMaxRemarks);
    }

    TEST_CASE("descriptions are short and on one line whatever the token is") {
        CHECK(tokens("\"a\nb\"") == "string \"a.b\" end of text");
        const std::string described = tokens('"' + std::string(1000, 'x') + '"');
        CHECK(described == "string \"" + std::string(32, 'x') + "...\" end of text");
        std::string accents;
        for (int i = 0; i < 100; i++) {
            accents += "\xe2\x82\xac";
        }
        CHECK(tokens('"' + accents + '"') == "string \"" + accents.substr(0, 30) + "...\" end of text");
    }
}

} // namespace cl
