#include <xxhash.h>

#include <algorithm>
#include <array>

#include "formats/compression.h"
#include "formats/container_rules.h"
#include "formats/little_endian.h"

namespace overlook::container {

struct Writer::HashState {
    XXH3_state_t* xxh3 = nullptr;
};

void Writer::HashStateDeleter::operator()(HashState* state) const noexcept {
    XXH3_freeState(state->xxh3);
    delete state;
}

namespace {

tl::unexpected<Error> misuse(const std::string& path, const std::string& what) {
    return tl::unexpected(Error{Exit::our_bug, path + ": " + what});
}

tl::unexpected<Error> breaks(int rule, const std::string& path, Tag tag) {
    return misuse(path, fmt::format("section {} would break C{}: {}", tag_text(tag), rule, rule_text(rule)));
}

void store_entry(std::span<std::byte> entry, const Section& section) {
    store_le(entry, entry_at::tag, section.tag);
    store_le(entry, entry_at::flags, section.flags);
    store_le(entry, entry_at::offset, section.offset);
    store_le(entry, entry_at::stored_bytes, section.stored_bytes);
    store_le(entry, entry_at::raw_bytes, section.raw_bytes);
    store_le(entry, entry_at::codec, uint32_t(section.codec));
    store_le(entry, entry_at::checksum, section.checksum);
}

using Head = std::array<std::byte, kFirstSectionOffset>;

// Header and table; everything not named is zero.
Head head_of(Tag kind, std::span<const Section> sections, uint64_t file_bytes) {
    Head head{};
    std::copy_n(reinterpret_cast<const std::byte*>(kMagic.data()), kMagic.size(), head.begin());
    store_le(head, header_at::major, kMajor);
    store_le(head, header_at::minor, kMinor);
    store_le(head, header_at::section_count, uint32_t(sections.size()));
    store_le(head, header_at::file_bytes, file_bytes);
    store_le(head, header_at::kind, kind);
    for (size_t i = 0; i < sections.size(); i++) {
        store_entry(std::span(head).subspan(kHeaderBytes + i * kEntryBytes, kEntryBytes), sections[i]);
    }
    store_le(head, header_at::checksum, checksum_of_head(head));
    return head;
}

}  // namespace

Result<Writer> Writer::create(const std::string& path, Tag kind) {
    if (!is_printable(kind)) return misuse(path, "its kind would break C8");
    Result<AtomicFile> file = AtomicFile::create(path);
    if (!file) return tl::unexpected(file.error());

    Writer writer(std::move(*file), kind);
    if (Result<void> room = writer.file_.append(Head{}); !room) return tl::unexpected(room.error());
    writer.position_ = kFirstSectionOffset;
    return writer;
}

Result<void> Writer::enter(Tag tag, uint32_t flags, Codec codec) {
    const std::string& path = file_.path();
    if (open_hash_) return misuse(path, "section " + tag_text(tag) + " is begun inside another");
    if (sections_.size() == kMaxSections) return breaks(6, path, tag);
    if (!is_printable(tag)) return breaks(8, path, tag);
    if (std::any_of(sections_.begin(), sections_.end(), [&](const Section& s) { return s.tag == tag; })) {
        return breaks(9, path, tag);
    }
    if ((flags & ~(kMustUnderstand | kCheckedInParts)) != 0) return breaks(10, path, tag);
    if (codec != Codec::none && codec != Codec::zstd) return breaks(11, path, tag);
    if ((flags & kCheckedInParts) != 0 && codec != Codec::none) return breaks(12, path, tag);

    sections_.push_back({.tag = tag, .flags = flags, .codec = codec, .offset = position_});
    return {};
}

Result<void> Writer::pad() {
    constexpr std::array<std::byte, kAlignment> kZeros{};
    uint64_t missing = padded(position_) - position_;
    position_ += missing;
    return file_.append(std::span(kZeros).first(size_t(missing)));
}

Result<void> Writer::add(Tag tag, uint32_t flags, Codec codec, std::span<const std::byte> raw) {
    if (Result<void> entered = enter(tag, flags, codec); !entered) return entered;
    std::vector<std::byte> compressed;
    std::span<const std::byte> stored = raw;
    if (codec == Codec::zstd) {
        Result<std::vector<std::byte>> frame = zstd_compressed(file_.path(), raw);
        if (!frame) return tl::unexpected(frame.error());
        compressed = std::move(*frame);
        stored = compressed;
    }

    if (Result<void> written = file_.append(stored); !written) return written;
    Section& section = sections_.back();
    section.stored_bytes = stored.size();
    section.raw_bytes = raw.size();
    section.checksum = checksum_of(stored);
    position_ += stored.size();
    return pad();
}

Result<void> Writer::begin(Tag tag, uint32_t flags) {
    if (Result<void> entered = enter(tag, flags, Codec::none); !entered) return entered;
    open_hash_.reset(new HashState{XXH3_createState()});
    if (open_hash_->xxh3 == nullptr || XXH3_64bits_reset(open_hash_->xxh3) != XXH_OK) {
        return impossible("{}: there is not enough memory to begin a section", file_.path());
    }
    return {};
}

Result<void> Writer::append(std::span<const std::byte> piece) {
    if (!open_hash_) return misuse(file_.path(), "bytes are appended outside a section");
    if (Result<void> written = file_.append(piece); !written) return written;
    if (!piece.empty()) XXH3_64bits_update(open_hash_->xxh3, piece.data(), piece.size());
    position_ += piece.size();
    return {};
}

Result<void> Writer::end() {
    if (!open_hash_) return misuse(file_.path(), "a section is ended that was not begun");
    Section& section = sections_.back();
    section.stored_bytes = section.raw_bytes = position_ - section.offset;
    section.checksum = XXH3_64bits_digest(open_hash_->xxh3);
    open_hash_.reset();
    return pad();
}

Result<void> Writer::add_provenance(const Provenance& provenance) {
    Result<std::string> text = json_from_provenance(provenance);
    if (!text) return misuse(file_.path(), text.error().message);
    return add(kProvenanceTag, 0, Codec::none, std::as_bytes(std::span(text->data(), text->size())));
}

Result<uint64_t> Writer::commit() {
    if (open_hash_) return misuse(file_.path(), "committed while section " + tag_text(sections_.back().tag) + " is open");
    if (Result<void> head = file_.write_at(0, head_of(kind_, sections_, position_)); !head) return tl::unexpected(head.error());
    if (Result<void> done = file_.commit(); !done) return tl::unexpected(done.error());
    return position_;
}

}  // namespace overlook::container
