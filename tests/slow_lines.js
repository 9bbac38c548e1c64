// Every message between page and server takes a while of its own; in each direction they arrive in their order.
{
  class Line {
    #due = 0;
    #waiting = [];
    later(job) {
      this.#due = Math.max(this.#due, performance.now() + Math.random() * MOST_MS);
      this.#waiting.push(job);
      setTimeout(() => this.#waiting.shift()(), this.#due - performance.now());
    }
  }
  window.WebSocket = class extends window.WebSocket {
    #there = new Line();
    #back = new Line();
    send(data) {
      this.#there.later(() => this.readyState === this.OPEN && super.send(data));
    }
    set onmessage(hear) {
      super.onmessage = hear && ((event) => this.#back.later(() => hear.call(this, event)));
    }
    get onmessage() {
      return super.onmessage;
    }
  };
}
