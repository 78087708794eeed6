#include <algorithm>
#include <new>

#include "formats/compression.h"
#include "formats/container_rules.h"
#include "formats/little_endian.h"

namespace overlook::container {
namespace {

using Bytes = std::span<const std::byte>;

bool is_zero(Bytes bytes) {
    return std::all_of(bytes.begin(), bytes.end(), [](std::byte b) { return b == std::byte(0); });
}

bool begins_with(Bytes bytes, std::string_view text) {
    return bytes.size() >= text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin(), [](char c, std::byte b) { return std::byte(c) == b; });
}

// "section 2 (NOTE)", counted from 1.
std::string place_of(size_t index, const Section& section) {
    return fmt::format("section {} ({})", index + 1, tag_text(section.tag));
}

// C1..C6: whatever breaks one of these makes the rest meaningless.
Result<void> check_header(Bytes bytes, const std::string& name) {
    if (bytes.empty()) return broken(1, name, "the file is empty");
    if (!begins_with(bytes, kMagic)) {
        bool was_ours = begins_with(bytes, kMagic.substr(0, 4)) || begins_with(bytes, "\x09OVL") || begins_with(bytes, "?OVL");
        if (was_ours) return broken(1, name, "its first bytes were changed; was it copied as text instead of binary?");
        return broken(1, name, "this is not a baked file (.ovl)");
    }
    if (bytes.size() < kFirstSectionOffset) {
        return broken(2, name, "the file is {} bytes long, less than the {} of its header and table; was the copy cut short?",
                      with_commas(bytes.size()), with_commas(kFirstSectionOffset));
    }

    auto major = load_le<uint16_t>(bytes, header_at::major);
    if (major != kMajor) {
        return broken(3, name, "major version {}, this program reads {}; bake it again or use the Overlook that wrote it", major,
                      kMajor);
    }
    auto file_bytes = load_le<uint64_t>(bytes, header_at::file_bytes);
    if (file_bytes != bytes.size()) {
        return broken(4, name, "the file is {} bytes long, its header says {}; {}", with_commas(bytes.size()),
                      with_commas(file_bytes),
                      bytes.size() < file_bytes ? "was the copy cut short?" : "was something appended to it?");
    }
    auto checksum = load_le<uint64_t>(bytes, header_at::checksum);
    uint64_t measured = checksum_of_head(bytes.first(kFirstSectionOffset));
    if (checksum != measured) {
        return broken(5, name, "header and table have checksum {:016x}, the header says {:016x}; copy or bake the file again",
                      measured, checksum);
    }
    auto count = load_le<uint32_t>(bytes, header_at::section_count);
    if (count > kMaxSections) {
        return broken(6, name, "the header counts {} sections, the table has room for {}", with_commas(count), kMaxSections);
    }
    return {};
}

// C7, C8 of header and table.
Result<void> check_reserved_and_tags(Bytes bytes, std::span<const Section> sections, Tag kind, const std::string& name) {
    if (!is_zero(bytes.subspan(header_at::reserved, kHeaderBytes - header_at::reserved))) {
        return broken(7, name, "the header's bytes {} to {} are not zero", header_at::reserved, kHeaderBytes - 1);
    }
    for (size_t i = 0; i < kMaxSections; i++) {
        Bytes entry = bytes.subspan(kHeaderBytes + i * kEntryBytes, kEntryBytes);
        if (i >= sections.size()) {
            if (!is_zero(entry)) return broken(7, name, "entry {} of the table is not in use and not zero", i + 1);
            continue;
        }
        if (load_le<uint32_t>(entry, entry_at::reserved_word) != 0 || !is_zero(entry.subspan(entry_at::reserved))) {
            return broken(7, name, "reserved bytes of {} are not zero", place_of(i, sections[i]));
        }
    }
    if (!is_printable(kind)) return broken(8, name, "the kind {:08x} is not printable", kind);
    for (size_t i = 0; i < sections.size(); i++) {
        if (!is_printable(sections[i].tag))
            return broken(8, name, "the tag {:08x} of section {} is not printable", sections[i].tag, i + 1);
    }
    return {};
}

// C10..C13: an entry by itself.
Result<void> check_meaning(size_t index, const Section& section, const std::string& name) {
    std::string place = place_of(index, section);
    if ((section.flags & ~(kMustUnderstand | kCheckedInParts)) != 0) {
        return broken(10, name, "{} has flags {:#x}, known are 1 and 2", place, section.flags);
    }
    if (section.codec != Codec::none && section.codec != Codec::zstd) {
        return broken(11, name, "{} has codec {}, known are 0 and 1; a newer Overlook may read it", place,
                      uint32_t(section.codec));
    }
    if ((section.flags & kCheckedInParts) != 0 && section.codec != Codec::none) {
        return broken(12, name, "{} is checked in parts and has codec {}", place, uint32_t(section.codec));
    }
    if (section.codec == Codec::none && section.stored_bytes != section.raw_bytes) {
        return broken(13, name, "{} has codec 0, {} stored and {} raw bytes", place, with_commas(section.stored_bytes),
                      with_commas(section.raw_bytes));
    }
    return {};
}

// C14..C16 and C18: where an entry's bytes lie. `expected` is where they must begin; returns where the next must.
// No sum can wrap around: each length is compared with what is left of the file.
Result<uint64_t> check_place(Bytes bytes, size_t index, const Section& section, uint64_t expected, const std::string& name) {
    std::string place = place_of(index, section);
    if (section.offset % kAlignment != 0) {
        return broken(14, name, "{} begins at {}, not at a multiple of {}", place, with_commas(section.offset), kAlignment);
    }
    if (section.offset != expected) {
        return broken(15, name, "{} begins at {}, the bytes before it end at {}", place, with_commas(section.offset),
                      with_commas(expected));
    }
    if (section.offset > bytes.size() || section.stored_bytes > bytes.size() - section.offset) {
        return broken(16, name, "{} begins at {} and has {} bytes, the file has {}", place, with_commas(section.offset),
                      with_commas(section.stored_bytes), with_commas(bytes.size()));
    }
    return padded(section.offset + section.stored_bytes);
}

Section section_at(Bytes entry) {
    return {.tag = load_le<uint32_t>(entry, entry_at::tag),
            .flags = load_le<uint32_t>(entry, entry_at::flags),
            .codec = Codec(load_le<uint32_t>(entry, entry_at::codec)),
            .offset = load_le<uint64_t>(entry, entry_at::offset),
            .stored_bytes = load_le<uint64_t>(entry, entry_at::stored_bytes),
            .raw_bytes = load_le<uint64_t>(entry, entry_at::raw_bytes),
            .checksum = load_le<uint64_t>(entry, entry_at::checksum)};
}

// C9..C18: each entry, then the file's end, then the bytes between.
Result<void> check_sections(Bytes bytes, std::span<const Section> sections, const std::string& name) {
    uint64_t end = kFirstSectionOffset;
    for (size_t i = 0; i < sections.size(); i++) {
        const Section& section = sections[i];
        for (size_t j = 0; j < i; j++) {
            if (sections[j].tag == section.tag) {
                return broken(9, name, "{} has the tag of section {}", place_of(i, section), j + 1);
            }
        }
        if (Result<void> meant = check_meaning(i, section, name); !meant) return meant;
        Result<uint64_t> next = check_place(bytes, i, section, end, name);
        if (!next) return tl::unexpected(next.error());
        end = *next;
    }
    if (end != bytes.size()) {
        return broken(17, name, "the sections end at {}, the file at {}", with_commas(end), with_commas(bytes.size()));
    }
    for (size_t i = 0; i < sections.size(); i++) {
        uint64_t begin = sections[i].offset + sections[i].stored_bytes;
        if (!is_zero(bytes.subspan(size_t(begin), size_t(padded(begin) - begin)))) {
            return broken(18, name, "the bytes after {}, at {}, are not zero", place_of(i, sections[i]), with_commas(begin));
        }
    }
    return {};
}

}  // namespace

Result<Reader> Reader::open(const std::string& path) {
    Result<MappedFile> file = MappedFile::open(path);
    if (!file) return tl::unexpected(file.error());
    Result<Reader> reader = open_bytes(file->bytes(), path);
    if (reader) reader->file_ = std::move(*file);
    return reader;
}

Result<Reader> Reader::open_bytes(std::span<const std::byte> bytes, std::string name) {
    if (Result<void> header = check_header(bytes, name); !header) return tl::unexpected(header.error());

    Reader reader;
    reader.bytes_ = bytes;
    reader.kind_ = load_le<uint32_t>(bytes, header_at::kind);
    auto count = load_le<uint32_t>(bytes, header_at::section_count);
    for (size_t i = 0; i < count; i++) {
        reader.sections_.push_back(section_at(bytes.subspan(kHeaderBytes + i * kEntryBytes, kEntryBytes)));
    }

    Result<void> form = check_reserved_and_tags(bytes, reader.sections_, reader.kind_, name);
    if (form) form = check_sections(bytes, reader.sections_, name);
    if (!form) return tl::unexpected(form.error());
    reader.name_ = std::move(name);
    return reader;
}

const Section* Reader::find(Tag tag) const {
    auto found = std::find_if(sections_.begin(), sections_.end(), [&](const Section& s) { return s.tag == tag; });
    return found == sections_.end() ? nullptr : &*found;
}

Result<void> Reader::require_known(std::span<const Tag> known) const {
    for (const Section& section : sections_) {
        bool is_known = std::find(known.begin(), known.end(), section.tag) != known.end();
        if ((section.flags & kMustUnderstand) != 0 && !is_known) {
            return broken(22, name_, "section {} must be understood and is not; a newer Overlook may read the file",
                          tag_text(section.tag));
        }
    }
    return {};
}

std::span<const std::byte> Reader::stored(const Section& section) const {
    return bytes_.subspan(size_t(section.offset), size_t(section.stored_bytes));
}

Result<void> Reader::check(const Section& section) const {
    uint64_t measured = checksum_of(stored(section));
    if (measured == section.checksum) return {};
    return broken(20, name_, "section {} at {} has checksum {:016x}, the table says {:016x}; copy or bake the file again",
                  tag_text(section.tag), with_commas(section.offset), measured, section.checksum);
}

Result<std::vector<std::byte>> Reader::read(const Section& section, uint64_t max_raw_bytes) const {
    std::string tag = tag_text(section.tag);
    if (section.raw_bytes > max_raw_bytes) {
        return broken(19, name_, "section {} has {} raw bytes, at most {} make sense", tag, with_commas(section.raw_bytes),
                      with_commas(max_raw_bytes));
    }
    if (Result<void> checked = check(section); !checked) return tl::unexpected(checked.error());
    if (section.codec == Codec::zstd) {
        std::string fault = fault_of_zstd_frame(stored(section), section.raw_bytes);
        if (!fault.empty()) return broken(21, name_, "section {} {}", tag, fault);
    }
    try {
        if (section.codec == Codec::none) return std::vector<std::byte>(stored(section).begin(), stored(section).end());
        std::vector<std::byte> raw(size_t(section.raw_bytes));
        std::string fault = zstd_decode(stored(section), raw);
        if (!fault.empty()) return broken(21, name_, "section {} {}", tag, fault);
        return raw;
    } catch (const std::bad_alloc&) {
        return impossible("{}: section {} needs {} bytes of memory, which are not there", name_, tag,
                          with_commas(section.raw_bytes));
    }
}

Result<Provenance> Reader::provenance() const {
    const Section* section = find(kProvenanceTag);
    if (section == nullptr) return broken(23, name_, "there is no section PROV, which says where the file came from");
    Result<std::vector<std::byte>> text = read(*section, kMaxProvenanceBytes);
    if (!text) return tl::unexpected(text.error());

    auto provenance = provenance_from_json({reinterpret_cast<const char*>(text->data()), text->size()});
    if (!provenance) return broken(23, name_, "section PROV: {}", provenance.error());
    return *std::move(provenance);
}

}  // namespace overlook::container
