// Sends events to the server once each and in their order, also when the connection breaks on the way.
{
  let count = 0;
  let isListening = false;
  const unanswered = [];

  const listen = () => {
    isListening = true;
    window.socket.on("connect", () => {
      for (const { send, payload } of unanswered) send(payload);
    });
  };
  window.deliver = (send, fields) => {
    const payload = { ...fields, delivery: (count += 1) };
    unanswered.push({ send, payload });
    if (!isListening && window.socket) listen();
    // The socket would send what it keeps while it is not connected after the connection, and so after newer events.
    if (!isListening || window.socket.connected) send(payload);
  };
  /** The server has handled all events up to this number. */
  window.confirmDelivery = (number) => {
    while (unanswered[0]?.payload.delivery <= number) unanswered.shift();
  };
}
