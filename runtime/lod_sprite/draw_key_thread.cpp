#include "runtime/lod_sprite/draw_key_thread.h"

#include <cassert>
#include <limits>
#include <utility>

namespace overlook::lod_sprite {

// What the thread has for itself, made and ended with its context current.
struct KeyThread::Worker {
    std::unique_ptr<DrawnGeometry> thing;
    gl::Program program;

    static Result<std::unique_ptr<Worker>> make(const DrawnGeometry& shared) {
        auto made = std::make_unique<Worker>();
        Result<std::unique_ptr<DrawnGeometry>> own = shared.sharing();
        if (!own) return tl::unexpected(own.error());
        made->thing = std::move(*own);
        Result<gl::Program> program = key_program(made->thing->slice());
        if (!program) return tl::unexpected(program.error());
        made->program = std::move(*program);
        return made;
    }
};

Result<std::unique_ptr<KeyThread>> KeyThread::start(const DrawnGeometry& thing, const gl::SecondContextMaker& second) {
    Result<std::unique_ptr<gl::SecondContext>> context = second();
    if (!context) return tl::unexpected(context.error());
    glFinish();  // the other context is to see what is on the card whole
    std::unique_ptr<KeyThread> made(new KeyThread(std::move(*context)));
    made->thread_ = std::thread([thread = made.get(), &thing] { thread->run(thing); });
    std::unique_lock lock(made->mutex_);
    made->changed_.wait(lock, [&] { return made->started_.has_value(); });
    if (!*made->started_) {
        Error error = made->started_->error();
        lock.unlock();
        return tl::unexpected(error);
    }
    lock.unlock();
    return made;
}

KeyThread::~KeyThread() {
    {
        std::lock_guard lock(mutex_);
        is_ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void KeyThread::begin(const Order& order) {
    glFlush();  // textures made for this order are made
    {
        std::lock_guard lock(mutex_);
        assert(!is_under_way_);
        is_under_way_ = true;
        order_ = order;
    }
    changed_.notify_all();
}

Result<KeyThread::Done> KeyThread::wait() {
    std::unique_lock lock(mutex_);
    assert(is_under_way_);
    changed_.wait(lock, [&] { return done_.has_value(); });
    Result<Done> done = std::move(*done_);
    done_.reset();
    is_under_way_ = false;
    return done;
}

void KeyThread::drop() {
    if (is_under_way_) static_cast<void>(wait());
}

void KeyThread::run(const DrawnGeometry& thing) {
    auto tell_started = [&](Result<void> result) {
        std::lock_guard lock(mutex_);
        started_ = std::move(result);
        changed_.notify_all();
    };
    if (!context_->make_current()) return tell_started(impossible("the second context cannot be used by another thread"));
    Result<std::unique_ptr<Worker>> worker = Worker::make(thing);
    tell_started(worker ? Result<void>() : tl::unexpected(worker.error()));
    while (worker) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return order_.has_value() || is_ending_; });
        if (!order_) break;
        Order order = *order_;
        order_.reset();
        lock.unlock();
        Result<Done> done = draw(**worker, order);
        lock.lock();
        done_ = std::move(done);
        changed_.notify_all();
    }
    if (worker) worker->reset();
    context_->release();
}

Result<KeyThread::Done> KeyThread::draw(Worker& worker, const Order& order) {
    Result<gl::Framebuffer> framebuffer = framebuffer_of(order.picture);
    if (!framebuffer) return tl::unexpected(framebuffer.error());
    begin_picture(*framebuffer, order.picture);
    DrawnGeometry& thing = *worker.thing;
    thing.geometry().begin_key(order.picture.camera, order.error_px);
    CutCount count = thing.geometry().next_slice(std::numeric_limits<uint64_t>::max()).count;
    uint64_t uploaded_bytes = thing.take_slice();
    worker.program.use();
    gl::bind_for_drawing(framebuffer->id(), order.picture.drawn_camera.width_px, order.picture.drawn_camera.height_px);
    thing.slice().draw(worker.program, order.picture.drawn_camera);
    finish_picture(*framebuffer, order.picture, thing.slice());
    Done done{read_depth(order.picture, order.grid_step), count, thing.slice().draw_call_count(), uploaded_bytes};
    glFinish();
    if (GLenum error = glGetError(); error != GL_NO_ERROR)
        return tl::unexpected(Error{Exit::our_bug, fmt::format("a key's own thread: OpenGL error 0x{:04x}", error)});
    return done;
}

}  // namespace overlook::lod_sprite
