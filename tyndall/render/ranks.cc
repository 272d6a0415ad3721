#include "tyndall/render/ranks.h"

#include <mpi.h>

#include <chrono>
#include <cstring>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <type_traits>

#include "tyndall/render/parallel.h"

namespace tyndall {
namespace {

static_assert(std::is_trivially_copyable_v<Pixel>, "pixels cross between processes as they are");

// Messages. A worker (a thread of a rank > 0) sends what it has done, or a greeting; the answer, when there is work,
// comes under a tag of its own.
constexpr int done_tag = 1, first_worker_tag = 16;
constexpr std::int32_t nothing = -1;

struct Head {
  std::int32_t worker, tile, level;  // tile: its number, or `nothing`: a greeting, a dismissal
};

using Message = std::vector<std::uint8_t>;

/// How long to sleep where there is no message [us]: a tile takes milliseconds, and whoever spins takes a core from one
/// who computes.
constexpr auto pause = std::chrono::microseconds(100);

Message packed(const Head& head, const Tile* tile, SampleFilm* film) {
  Message message(sizeof head + (tile != nullptr ? sizeof(Pixel) * static_cast<std::size_t>(tile->pixel_count()) : 0));
  std::memcpy(message.data(), &head, sizeof head);
  if (tile != nullptr) {
    std::uint8_t* at = message.data() + sizeof head;
    for_each_pixel(*tile, [&](int x, int y) {
      std::memcpy(at, &film->at(x, y), sizeof(Pixel));
      at += sizeof(Pixel);
    });
  }
  return message;
}

Head head_of(const Message& message) {
  Head head;
  std::memcpy(&head, message.data(), sizeof head);
  return head;
}

void unpack(const Message& message, const Tile& tile, SampleFilm& film) {
  const std::uint8_t* at = message.data() + sizeof(Head);
  for_each_pixel(tile, [&](int x, int y) {
    std::memcpy(static_cast<void*>(&film.at(x, y)), at, sizeof(Pixel));
    at += sizeof(Pixel);
  });
}

}  // namespace

struct Ranks::State : TileHelpers {
  int rank = 0, size = 1;
  std::mutex mpi;  // MPI_THREAD_SERIALIZED: one thread at a time
  struct Worker {
    int rank, number;
  };
  std::vector<Worker> waiting;  // who has asked for work and had no answer
  int under_way = 0;            // tiles given out
  int workers = 0;              // of all other ranks
  bool in_order = false;

  void send(const Message& message, int to, int tag) {
    // A tile is above the size that is sent without waiting for the receiver, who polls for it.
    MPI_Request request;
    {
      const std::lock_guard lock(mpi);
      MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD, &request);
    }
    for (int over = 0;;) {
      {
        const std::lock_guard lock(mpi);
        MPI_Test(&request, &over, MPI_STATUS_IGNORE);
      }
      if (over) return;
      std::this_thread::sleep_for(pause);
    }
  }

  /// The next message of a tag, or nothing where none is there yet.
  bool receive(Message& message, int from, int tag, int* sender = nullptr) {
    const std::lock_guard lock(mpi);
    int there = 0, bytes = 0;
    MPI_Status status;
    MPI_Iprobe(from, tag, MPI_COMM_WORLD, &there, &status);
    if (!there) return false;
    MPI_Get_count(&status, MPI_BYTE, &bytes);
    message.resize(static_cast<std::size_t>(bytes));
    MPI_Recv(message.data(), bytes, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (sender != nullptr) *sender = status.MPI_SOURCE;
    return true;
  }

  /// Rank 0: takes in a message if there is one; a tile that it brings goes into the film.
  bool take_in(const std::vector<Tile>& tiles, SampleFilm& film) {
    Message message;
    int sender = 0;
    if (!receive(message, MPI_ANY_SOURCE, done_tag, &sender)) return false;
    const Head head = head_of(message);
    waiting.push_back({sender, head.worker});
    if (head.tile != nothing) {
      unpack(message, tiles[static_cast<std::size_t>(head.tile)], film);
      --under_way;
    }
    return true;
  }

  void work(const TileSource& source, SampleFilm& film) override {
    while (!source.empty() || under_way > 0) {
      bool idle = true;
      while (!waiting.empty()) {
        const std::optional<std::size_t> i = source.take();
        if (!i) break;
        const Worker worker = waiting.back();
        waiting.pop_back();
        const Head head{worker.number, static_cast<std::int32_t>(*i), source.level};
        send(packed(head, &source.tiles[*i], &film), worker.rank, first_worker_tag + worker.number);
        ++under_way;
        idle = false;
      }
      while (take_in(source.tiles, film)) idle = false;
      if (idle) std::this_thread::sleep_for(pause);
    }
  }
};

Ranks::Ranks() : state_(std::make_unique<State>()) {
  int granted = 0;
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &granted) != MPI_SUCCESS ||
      granted < MPI_THREAD_SERIALIZED)
    throw std::runtime_error("this MPI does not let several threads of a process send messages");
  MPI_Comm_rank(MPI_COMM_WORLD, &state_->rank);
  MPI_Comm_size(MPI_COMM_WORLD, &state_->size);
}

Ranks::~Ranks() {
  // The others wait for messages that nobody will send.
  if (!state_->in_order) MPI_Abort(MPI_COMM_WORLD, 1);
  MPI_Finalize();
}

void Ranks::leave() { state_->in_order = true; }

int Ranks::rank() const { return state_->rank; }
int Ranks::size() const { return state_->size; }

std::string Ranks::first_text(const std::string& own) {
  const std::lock_guard lock(state_->mpi);
  int candidate = own.empty() ? state_->size : state_->rank, first = 0;
  MPI_Allreduce(&candidate, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  if (first == state_->size) return "";
  int length = static_cast<int>(own.size());
  MPI_Bcast(&length, 1, MPI_INT, first, MPI_COMM_WORLD);
  std::string text = own;
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, first, MPI_COMM_WORLD);
  return text;
}

int Ranks::least(int own) {
  int least = own;
  MPI_Allreduce(&own, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return least;
}

TileHelpers& Ranks::helpers() {
  const int none = 0;
  MPI_Reduce(&none, &state_->workers, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
  return *state_;
}

void Ranks::dismiss() {
  State& state = *state_;
  const std::vector<Tile> none;
  SampleFilm no_film(1, 1);
  // Each worker asks once more before it can be let go.
  for (int dismissed = 0; dismissed < state.workers;) {
    if (!state.take_in(none, no_film)) std::this_thread::sleep_for(pause);
    for (; !state.waiting.empty(); ++dismissed) {
      const State::Worker worker = state.waiting.back();
      state.waiting.pop_back();
      state.send(packed({worker.number, nothing, 0}, nullptr, nullptr), worker.rank, first_worker_tag + worker.number);
    }
  }
}

void Ranks::serve(const Scene& scene, const Geometry& geometry, const RenderSettings& settings) {
  State& state = *state_;
  const std::vector<Tile> tiles = tiles_of(scene.film.width, scene.film.height, settings.tile_order);
  const int threads = thread_count(settings.threads);
  MPI_Reduce(&threads, nullptr, 1, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
  const std::unique_ptr<Sampler> sampler = Sampler::make(scene, geometry, settings, threads);
  SampleFilm film(scene.film.width, scene.film.height);
  for_each_block(static_cast<std::size_t>(threads), threads, [&](std::size_t block, int) {
    const int worker = static_cast<int>(block);
    Message message = packed({worker, nothing, 0}, nullptr, nullptr);
    for (;;) {
      state.send(message, 0, done_tag);
      while (!state.receive(message, 0, first_worker_tag + worker)) std::this_thread::sleep_for(pause);
      const Head head = head_of(message);
      if (head.tile == nothing) return;
      const Tile& tile = tiles[static_cast<std::size_t>(head.tile)];
      unpack(message, tile, film);
      for_each_pixel(tile, [&](int x, int y) {
        Pixel& pixel = film.at(x, y);
        while (static_cast<int>(pixel.samples) < head.level) sampler->add(x, y, pixel, worker);
      });
      message = packed(head, &tile, &film);
    }
  });
}

}  // namespace tyndall
