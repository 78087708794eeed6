// Images of a file that come while a field is drawn: read ahead by threads, kept within a budget. The frame never waits for one:
// another stands in for what is not there.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "formats/wang_ldi.h"
#include "runtime/stream/stream.h"
#include "runtime/wang_ldi/field.h"
#include "runtime/wang_ldi/prepared_ldi.h"

namespace overlook::wang_ldi {

// An image as it is kept: for the exact warper, and for the fast one.
struct StoredImage {
    Ldi ldi;
    PreparedLdi prepared;

    static StoredImage of(Ldi ldi);
};
// What it takes in memory, exactly.
uint64_t bytes_of(const ImageSet& set, uint32_t level, const Entry& entry);

// All calls by one thread, that of the frames: begin_frame, take, perhaps look_ahead, end_frame; then at() by any until the next
// begin_frame.
class ImageStore {
  public:
    // Reads the coarsest level whole, which never goes. images and what it reads from must outlive this. Fails as Stream::open,
    // Stream::keep and ImageReader::read.
    static Result<std::unique_ptr<ImageStore>> open(const std::string& name, const ImageReader& images,
                                                    const stream::Settings& settings);

    // Lets go what was dropped. What cannot be read is told of once.
    const std::vector<Error>& begin_frame();

    struct Taken {
        uint64_t images = 0;     // that are shown
        uint64_t stand_ins = 0;  // of them those for which another is shown: of the next levels or directions that are there
        uint64_t missing = 0;    // those for which none is there, which are left out
    };
    // Asks for all that the list shows, and shows others in place of what is not there.
    Taken take(const Field& field, FieldList& list);
    // Asks for what another list would show, after all of take().
    void look_ahead(const Field& field, const FieldList& list);
    void end_frame();

    // Null where it is not there. Any thread.
    const StoredImage* at(uint64_t index) const { return images_[size_t(index)].get(); }
    uint64_t bytes_of(uint64_t index) const { return bytes_[size_t(index)]; }  // that it takes when it is there
    bool is_settled() const { return stream_->is_settled(); }
    const stream::Counts& counts() const { return stream_->counts(); }
    const stream::Settings& settings() const { return stream_->settings(); }

  private:
    explicit ImageStore(const ImageReader& images);
    bool is_there(uint64_t index) const { return stream_->is_resident(uint32_t(index)) && at(index) != nullptr; }
    bool stand_in(const Field& field, Item& item, Shown& shown);

    const ImageReader* reader_;
    std::vector<std::unique_ptr<StoredImage>> decoded_;  // by workers, until the frame's thread takes them over
    std::vector<std::unique_ptr<StoredImage>> images_;   // [ldi_count]
    std::vector<uint64_t> bytes_;                        // [ldi_count]
    std::vector<Error> faults_;
    std::unique_ptr<stream::Stream> stream_;  // last: its workers use the others
};

}  // namespace overlook::wang_ldi
