// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/io/fingerprint.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include <openssl/evp.h>

#include "core/base/parallel.h"
#include "core/io/file_bytes.h"
#include "core/io/unique_fd.h"

namespace gyre {
namespace {

constexpr std::size_t kBlock = 1U << 18U;

// SHA-256 of what is added.
class Digest {
 public:
  Digest() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
    GYRE_CHECK(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }
  void add(std::string_view bytes) {
    GYRE_CHECK(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
  }
  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> sum{};
    unsigned int length = 0;
    GYRE_CHECK(EVP_DigestFinal_ex(context_.get(), sum.data(), &length) == 1);
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (unsigned int i = 0; i < length; ++i) {
      text += kDigits[sum[i] >> 4U];
      text += kDigits[sum[i] & 15U];
    }
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

}  // namespace

Result<std::string> fingerprintOf(const std::filesystem::path& file) {
  const UniqueFd fd(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!fd.valid()) return fileError(errno, "read", file);
  Digest digest;
  std::vector<char> block(kBlock);
  for (;;) {
    const auto got = ::read(fd.get(), block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return fileError(errno, "read", file);
    if (got == 0) return digest.hex();
    digest.add({block.data(), static_cast<std::size_t>(got)});
  }
}

Result<std::string> fingerprintOf(std::span<const std::filesystem::path> files, const Task& task) {
  std::vector<std::optional<Result<std::string>>> sums(files.size());
  parallelFor(files.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !task.stopRequested(); ++i) {
      sums[i] = fingerprintOf(files[i]);
    }
  });
  if (task.stopRequested()) return cancelled();
  Digest all;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!sums[i]->ok()) return sums[i]->error();
    all.add(**sums[i] + "  " + files[i].filename().string() + "\n");
  }
  return all.hex();
}

}  // namespace gyre
