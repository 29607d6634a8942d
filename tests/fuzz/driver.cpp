// A harness without libFuzzer, for any compiler: fuzzed-READER COUNT FILE... gives it COUNT mutations of the
// files, the same ones every time; fuzzed-READER 20s FILE... as many as 20 s have room for. MPM_FUZZ_SEED=N
// chooses others. Whatever the harness lets through (an exception, a signal) ends the
// program; the input is then in fuzzed-input. An input that takes longer than ten seconds ends it with
// SIGALRM.

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t limit) {
  return limit == 0 ? 0 : random() % limit;
}

/// Words that mean something to a reader, or went wrong once.
const std::vector<std::string> words = {
    "0",  "-1",   "1e9", "1e300",    "5e-324", "nan",    "inf",      "1000000000", "\"\"", "[]",
    "{}", "true", "\n",  "=",        ".",      "\"\"\"", "'''",      "\\u0000",    "\xff", "\xef\xbf\xbf",
    "[[", "]]",   ",",   "a.a.a.a.", "1e-30",  "1e30",   "\xc3\xa9", "#",          "-",    "2147483647"};

void mutate(std::string& text, Random& random, const std::vector<std::string>& corpus) {
  const std::size_t at = below(random, text.size() + 1);
  switch (random() % 8) {
    case 0:
      if (at < text.size()) text[at] = static_cast<char>(random());
      break;
    case 1:
      text.erase(at, below(random, 20));
      break;
    case 2:
      text.insert(at, words[below(random, words.size())]);
      break;
    case 3: {  // what stands behind an equals sign
      const std::size_t equals = text.find('=', at);
      if (equals == std::string::npos) break;
      const std::size_t end = text.find('\n', equals);
      text.replace(equals + 1, end == std::string::npos ? end : end - equals - 1,
                   " " + words[below(random, words.size())]);
      break;
    }
    case 4: {  // a line goes
      const std::size_t begin = text.rfind('\n', at), end = text.find('\n', at);
      if (begin != std::string::npos && end != std::string::npos && end > begin)
        text.erase(begin, end - begin);
      break;
    }
    case 5: {  // a piece of another
      const std::string& other = corpus[below(random, corpus.size())];
      text.insert(at, other.substr(below(random, other.size()), below(random, 200)));
      break;
    }
    case 6: {  // a digit
      const std::size_t digit = text.find_first_of("0123456789", at);
      if (digit != std::string::npos) text[digit] = static_cast<char>('0' + random() % 10);
      break;
    }
    default: {  // a piece twice
      const std::string piece = text.substr(at, below(random, 100));
      text.insert(below(random, text.size() + 1), piece);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: " << argv[0] << " COUNT|SECONDSs FILE...\n";
    return 2;
  }
  std::vector<std::string> corpus;
  for (int i = 2; i < argc; ++i) {
    std::ifstream in(argv[i], std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  const std::string asked = argv[1];
  const long number = std::stol(asked);
  const bool timed = asked.ends_with("s");
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(timed ? number : 0);
  const char* seed = std::getenv("MPM_FUZZ_SEED");
  Random random(seed != nullptr ? static_cast<Random::result_type>(std::stoul(seed)) : 1);
  long k = 0;
  for (; timed ? std::chrono::steady_clock::now() < end : k < number; ++k) {
    std::string text = corpus[static_cast<std::size_t>(k) % corpus.size()];
    for (std::size_t times = 1 + below(random, 4); times > 0; --times) mutate(text, random, corpus);
    std::ofstream("fuzzed-input", std::ios::binary) << text;
    alarm(10);
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
  std::cout << k << " inputs, no finding\n";
  return 0;
}
