// The container of every baked file (.ovl): a header, a table of sections, sections aligned to 64 bytes, checksums.
// Its document, with a drawing and a worked example, is formats/spec/container.md; the rules below are numbered there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/atomic_file.h"
#include "formats/mapped_file.h"
#include "formats/result.h"

namespace overlook::container {

// Four ASCII characters, first one in the lowest byte.
using Tag = uint32_t;
constexpr Tag tag(const char (&text)[5]) {
    return Tag(uint8_t(text[0])) | Tag(uint8_t(text[1])) << 8 | Tag(uint8_t(text[2])) << 16 | Tag(uint8_t(text[3])) << 24;
}
// The tag as text, unprintable bytes as '?'.
std::string tag_text(Tag tag);

enum class Codec : uint32_t { none = 0, zstd = 1 };

// Flags of a section.
constexpr uint32_t kMustUnderstand = 1u << 0;  // a reader that does not know this section's tag must refuse the file
// The section is a row of parts that its own format checks one by one; opening it never reads all of it. Only with Codec::none.
constexpr uint32_t kCheckedInParts = 1u << 1;

constexpr uint16_t kMajor = 1;
constexpr uint16_t kMinor = 0;
constexpr size_t kHeaderBytes = 64;
constexpr size_t kEntryBytes = 64;
constexpr size_t kAlignment = 64;
constexpr uint32_t kMaxSections = 63;  // what fits into the table's room; many like things are parts of one section
constexpr size_t kFirstSectionOffset = kHeaderBytes + kMaxSections * kEntryBytes;
static_assert(kFirstSectionOffset == 4096, "sections begin at the second page");
constexpr Tag kProvenanceTag = tag("PROV");
constexpr uint64_t kMaxProvenanceBytes = 1 << 20;

struct Section {
    Tag tag = 0;
    uint32_t flags = 0;
    Codec codec = Codec::none;
    uint64_t offset = 0;        // from the start of the file, a multiple of kAlignment
    uint64_t stored_bytes = 0;  // in the file
    uint64_t raw_bytes = 0;     // after decoding
    uint64_t checksum = 0;      // XXH3-64 of the stored bytes
};

// Where a baked file came from. No date, no host, no path: the same bake gives the same bytes.
struct InputIdentity {
    std::string name;  // bare file name
    std::string hash;  // XXH3-128 of the bytes, 32 hex digits
};
struct Provenance {
    std::string program;                                       // "bake-lod terrain"
    std::string version;                                       // of Overlook
    std::vector<std::pair<std::string, std::string>> options;  // those that decide the bytes; kept sorted by name, no name twice
    std::vector<InputIdentity> inputs;
};

// Writes a baked file under a temporary name beside its final one; commit() makes it appear whole (fsync, rename).
// A writer that is destroyed before commit() leaves an existing file of that name as it was.
// What the disk refuses is Exit::cannot_write; a call that breaks a rule of the format (a tag used twice, a 64th section, append
// without begin) is Exit::our_bug, in every build: a file that breaks its own rules is never written.
class Writer {
  public:
    // kind: what the file is as a whole, e.g. tag("TERR"). Fails with Exit::cannot_write.
    static Result<Writer> create(const std::string& path, Tag kind);

    // A whole section at once, compressed by `codec`. raw may be empty. A tag may be used once.
    // Codec::zstd: one frame, one thread; the same bytes for the same version of zstd.
    Result<void> add(Tag tag, uint32_t flags, Codec codec, std::span<const std::byte> raw);

    // A section in pieces, stored as they come (Codec::none): begin, append ..., end.
    Result<void> begin(Tag tag, uint32_t flags);
    Result<void> append(std::span<const std::byte> piece);
    Result<void> end();

    // The section PROV. Options are sorted by name; bytes of a name that are not UTF-8 become U+FFFD.
    Result<void> add_provenance(const Provenance& provenance);

    // Writes header and table, flushes to the disk, renames. Returns the file's size in bytes.
    Result<uint64_t> commit();

  private:
    struct HashState;  // running XXH3-64 of the section begun
    struct HashStateDeleter {
        void operator()(HashState* state) const noexcept;
    };

    Writer(AtomicFile file, Tag kind) : file_(std::move(file)), kind_(kind) {}
    Result<void> enter(Tag tag, uint32_t flags, Codec codec);
    Result<void> pad();

    AtomicFile file_;
    Tag kind_;
    std::vector<Section> sections_;
    uint64_t position_ = 0;
    std::unique_ptr<HashState, HashStateDeleter> open_hash_;  // null unless a section is begun
};

// A baked file, mapped. open() checks header, table and padding (rules C1..C18 of the document) and nothing of the sections'
// bytes; those are checked when they are asked for (C19..C23). The file may be hostile; every failure of form is Exit::bad_input
// and names file, rule and place: "valley.ovl: C4: the file is 4,096 bytes long, its header says 8,192; was the copy cut short?"
// The file must not be shortened while it is mapped: the system would end the process (SIGBUS). Overlook's writers never do that,
// they put a new file in the old one's place.
class Reader {
  public:
    static Result<Reader> open(const std::string& path);
    // The same over bytes in memory (tests, fuzzing); `name` stands in messages. The bytes must outlive the reader.
    static Result<Reader> open_bytes(std::span<const std::byte> bytes, std::string name);

    const std::string& name() const { return name_; }
    Tag kind() const { return kind_; }
    uint64_t file_bytes() const { return bytes_.size(); }
    std::span<const Section> sections() const { return sections_; }
    const Section* find(Tag tag) const;  // null if there is none

    // Fails if a section flagged kMustUnderstand has a tag that is not in `known`.
    Result<void> require_known(std::span<const Tag> known) const;

    // The stored bytes in place, unchecked and undecoded (for sections checked in parts).
    std::span<const std::byte> stored(const Section& section) const;
    // Checksum of the stored bytes.
    Result<void> check(const Section& section) const;
    // The raw bytes of a section: checksum verified, decoded. Never allocates more than raw_bytes, which must be at most
    // `max_raw_bytes` (C19). Fails with Exit::impossible if there is not so much memory.
    Result<std::vector<std::byte>> read(const Section& section, uint64_t max_raw_bytes) const;

    // The section PROV; a file without one breaks C23.
    Result<Provenance> provenance() const;

  private:
    MappedFile file_;
    std::span<const std::byte> bytes_;
    std::string name_;
    Tag kind_ = 0;
    std::vector<Section> sections_;
};

// What each rule says in a sentence, for messages, documents and tests: rule_text(5) is the sentence of C5; empty if there is
// none.
std::string_view rule_text(int rule);
int rule_count();

}  // namespace overlook::container
