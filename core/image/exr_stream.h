#pragma once

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfIO.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cl {

/// Bytes in memory as OpenEXR reads them.
class ExrInput final : public Imf::IStream {
public:
    ExrInput(std::span<const uint8_t> bytes, std::string_view name)
        : IStream(std::string(name).c_str()), bytes_(bytes) {}

    bool read(char out[], int count) override {
        if (count < 0 || static_cast<uint64_t>(count) > bytes_.size() - at_) {
            throw IEX_NAMESPACE::InputExc("the data ends early");
        }
        std::memcpy(out, bytes_.data() + at_, static_cast<size_t>(count));
        at_ += static_cast<size_t>(count);
        return at_ < bytes_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t at) override {
        if (at > bytes_.size()) {
            throw IEX_NAMESPACE::InputExc("an offset beyond the end");
        }
        at_ = at;
    }

private:
    std::span<const uint8_t> bytes_;
    uint64_t at_ = 0;
};

/// Grows a vector with what OpenEXR writes.
class ExrOutput final : public Imf::OStream {
public:
    ExrOutput() : OStream("memory") {}

    void write(const char data[], int count) override {
        const auto end = at_ + static_cast<size_t>(count);
        if (end > bytes_.size()) {
            bytes_.resize(end);
        }
        std::memcpy(bytes_.data() + at_, data, static_cast<size_t>(count));
        at_ = end;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t at) override { at_ = at; }

    std::vector<uint8_t> take() { return std::move(bytes_); }

private:
    std::vector<uint8_t> bytes_;
    size_t at_ = 0;
};

} // namespace cl
