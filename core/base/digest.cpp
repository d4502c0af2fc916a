#include "core/base/digest.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <openssl/evp.h>

namespace forage {
namespace {

class Sha256 {
  public:
    Sha256() { EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr); }
    void add(std::string_view text) { EVP_DigestUpdate(context_.get(), text.data(), text.size()); }
    std::string text() {
        std::array<unsigned char, 32> bytes{};
        EVP_DigestFinal_ex(context_.get(), bytes.data(), nullptr);
        std::string out;
        for (const unsigned char byte : bytes) out += fmt::format("{:02x}", byte);
        return out;
    }

  private:
    std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(), EVP_MD_CTX_free};
};

}  // namespace

std::string digest(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return fmt::format("{:016x}", hash);
}

std::string sha256(std::string_view text) {
    Sha256 sum;
    sum.add(text);
    return sum.text();
}

std::string file_digest(const std::string& path) {
    Sha256 sum;
    std::error_code none;  // the content of a pipe cannot be read again
    if (!std::filesystem::is_regular_file(path, none)) return sum.text();
    std::ifstream in(path, std::ios::binary);
    for (std::vector<char> block(std::size_t{1} << 18); in;) {
        in.read(block.data(), static_cast<std::streamsize>(block.size()));
        sum.add({block.data(), static_cast<std::size_t>(in.gcount())});
    }
    return sum.text();
}

}  // namespace forage
