#include "cache/sha256.hpp"

#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <cstdint>
#include <memory>

#include "navjit/errors.hpp"

namespace navjit::cache {
namespace {

struct Free {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

class Hash {
 public:
  Hash() {
    // In exit() OpenSSL would clean up while the specialiser's thread may still hash.
    [[maybe_unused]] static const int stays = OPENSSL_init_crypto(OPENSSL_INIT_NO_ATEXIT, nullptr);
    context_.reset(EVP_MD_CTX_new());
    check(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }
  void add(std::string_view bytes) {
    check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }
  Digest finish() {
    Digest digest;
    unsigned size = 0;
    check(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1 && size == digest.size());
    return digest;
  }

 private:
  static void check(bool success) {
    if (!success) throw Error("SHA-256 is not available from the system's library");
  }
  std::unique_ptr<EVP_MD_CTX, Free> context_;
};

}  // namespace

Digest sha256_of_parts(std::initializer_list<std::string_view> parts) {
  Hash hash;
  for (const std::string_view part : parts) {
    std::uint64_t size = part.size();
    char length[8];  // least significant byte first, on every machine
    for (char& byte : length) {
      byte = static_cast<char>(size & 0xff);
      size >>= 8;
    }
    hash.add({length, sizeof length});
    hash.add(part);
  }
  return hash.finish();
}

Digest sha256(std::initializer_list<std::string_view> bytes) {
  Hash hash;
  for (const std::string_view part : bytes) hash.add(part);
  return hash.finish();
}

std::string hex(const Digest& digest) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

}  // namespace navjit::cache
