// Keys drawn beside the frames, by a thread with an OpenGL context of its own.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "runtime/gl/context.h"
#include "runtime/lod_sprite/draw.h"
#include "runtime/lod_sprite/draw_geometry.h"

namespace overlook::lod_sprite {

// One key at a time: begin(), then wait() or drop(). To be used, made and ended by one thread, whose context is current.
class KeyThread {
  public:
    // The thing must outlive it. Fails as gl::second_context and DrawnGeometry::sharing.
    static Result<std::unique_ptr<KeyThread>> start(const DrawnGeometry& thing, const gl::SecondContextMaker& second);
    KeyThread(const KeyThread&) = delete;
    KeyThread& operator=(const KeyThread&) = delete;
    ~KeyThread();  // waits for what is being drawn

    struct Order {
        KeyPicture picture;      // its textures must stay until the key is done
        double error_px = 1;     // of the cut, over picture.camera
        uint32_t grid_step = 1;  // of the depths read back (read_depth)
    };
    struct Done {
        DepthGrid depths;
        CutCount count;
        uint64_t draw_call_count = 0, uploaded_bytes = 0;
    };
    void begin(const Order& order);  // none must be under way
    Result<Done> wait();  // for what was begun: everything is drawn then. Fails with Exit::impossible and Exit::our_bug
    void drop();          // the same for whoever no longer wants it; also if nothing was begun

  private:
    struct Worker;
    explicit KeyThread(std::unique_ptr<gl::SecondContext> context) : context_(std::move(context)) {}
    void run(const DrawnGeometry& thing);
    Result<Done> draw(Worker& worker, const Order& order);

    std::unique_ptr<gl::SecondContext> context_;
    std::mutex mutex_;  // of all below
    std::condition_variable changed_;
    std::optional<Order> order_;
    std::optional<Result<Done>> done_;
    std::optional<Result<void>> started_;
    bool is_under_way_ = false, is_ending_ = false;
    std::thread thread_;  // last: it uses the others
};

}  // namespace overlook::lod_sprite
